// SPDX-License-Identifier: BSD-3-Clause
// Custom filters for tests. Each one derives from a stock filter whose promises its own `admits` does not keep.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/model/model.hpp"
#include "hinge/policy/different_links.hpp"
#include "hinge/policy/pair_filter.hpp"

namespace hinge::test {

/// A pseudo-random half of the pairs, symmetric in i and j, with no structure that an engine could use.
inline bool by_chance(PrimitiveId i, PrimitiveId j) noexcept {
  const auto [low, high] = std::minmax({static_cast<std::uint32_t>(index(i)), static_cast<std::uint32_t>(index(j))});
  return (philox({low, high, 0, 0}, {1, 2})[0] & 1U) != 0;
}

struct OwnOfAll : AdmitAll {
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept { return by_chance(i, j); }
};

/// Hides the base's test of links, so pairs of ignored links may be admitted.
struct OwnOfLinks : DifferentLinks {
  using DifferentLinks::DifferentLinks;
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept { return by_chance(i, j); }
};

/// Keeps the base's test of links and excludes further pairs.
struct OwnWithLinks : DifferentLinks {
  using DifferentLinks::admits;
  using DifferentLinks::DifferentLinks;
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept { return DifferentLinks::admits(i, j) && by_chance(i, j); }
};

/// Excludes pairs that the base does not list as excluded.
struct OwnOfList : ExcludedPairs {
  using ExcludedPairs::ExcludedPairs;
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept { return ExcludedPairs::admits(i, j) && by_chance(i, j); }
};

static_assert(!ListsExclusions<OwnOfAll> && !AdmitsLinks<OwnOfLinks> && AdmitsLinks<OwnWithLinks>);
static_assert(ListsExclusions<OwnOfList>);

/// Returns a custom filter for `model`, over a random base filter.
template <class F, class P>
F own_filter(const Model<P>& model, Random& random) {
  if constexpr (std::is_same_v<F, OwnOfAll>) {
    return {};
  } else if constexpr (std::is_same_v<F, OwnOfList>) {
    return F(model.size(), random, 5);
  } else {
    std::vector<std::pair<LinkId, LinkId>> ignored;
    const std::size_t links = model.tree().link_count();
    for (std::size_t k = 0; k < links; ++k)
      for (std::size_t l = 0; l < k; ++l)
        if (random.one_in(4)) ignored.emplace_back(id<LinkId>(k), id<LinkId>(l));
    return F({model.links().begin(), model.links().end()}, std::move(ignored));
  }
}

}  // namespace hinge::test
