// SPDX-License-Identifier: BSD-3-Clause
// PairFilter: which pairs of primitives are tested at all, and the filter that admits every pair.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>

#include "hinge/core/id.hpp"

namespace hinge {

/// Pure and symmetric: admits(i, j) == admits(j, i). Asked for i != j only. A pair counts only when admits says so:
/// every engine asks it of every pair that comes too close. The refinements below only save time: they say earlier, of
/// many pairs at once, what admits would say of each. hinge/policy/laws.hpp checks that they agree with it.
template <class F>
concept PairFilter = std::copyable<F> && requires(const F& filter, PrimitiveId i, PrimitiveId j) {
  { filter.admits(i, j) }
  noexcept->std::same_as<bool>;
};

/// Optional refinement: names primitives that are not admitted with i (sorted, without i), bonded atoms for example.
/// Engines look them up when they are prepared and leave such pairs out before distances are computed. Pairs that are
/// not listed may be refused by admits all the same.
template <class F>
concept ListsExclusions = PairFilter<F> && requires(const F& filter, PrimitiveId i) {
  { filter.excluded(i) }
  noexcept->std::convertible_to<std::span<const PrimitiveId>>;
};

/// Optional refinement: can refuse all pairs of two different links at once; where it does not, pairs are still asked
/// for. A class derived from such a filter that declares an admits(PrimitiveId, PrimitiveId) of its own hides this
/// function too, so that each pair is asked for.
template <class F>
concept AdmitsLinks = PairFilter<F> && requires(const F& filter, LinkId a, LinkId b) {
  { filter.admits(a, b) }
  noexcept->std::same_as<bool>;
};

/// Optional refinement of filters and matrices: made for exactly this many primitives; checked against the model.
template <class T>
concept KnowsSize = requires(const T& policy) {
  { policy.size() }
  noexcept->std::same_as<std::size_t>;
};

/// Optional refinement of filters that go by links: made for primitives that hang on these; checked against the model.
template <class F>
concept KnowsLinks = PairFilter<F> && requires(const F& filter) {
  { filter.links() }
  noexcept->std::convertible_to<std::span<const LinkId>>;
};

/// Every pair counts.
struct AdmitAll {
  bool admits(PrimitiveId, PrimitiveId) const noexcept { return true; }
};

static_assert(PairFilter<AdmitAll> && !ListsExclusions<AdmitAll> && !AdmitsLinks<AdmitAll>);

}  // namespace hinge
