// SPDX-License-Identifier: BSD-3-Clause
// PairFilter: which pairs of primitives are tested at all, and the filter that admits every pair.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>

#include "hinge/core/id.hpp"

namespace hinge {

/// Pure and symmetric: admits(i, j) == admits(j, i). Asked for i != j only.
template <class F>
concept PairFilter = std::copyable<F> && requires(const F& filter, PrimitiveId i, PrimitiveId j) {
  { filter.admits(i, j) }
  noexcept->std::same_as<bool>;
};

/// Optional refinement: can name the few primitives that are not admitted with i (sorted, without i), so that engines
/// look them up once when they are prepared and never in the inner loop.
template <class F>
concept ListsExclusions = PairFilter<F> && requires(const F& filter, PrimitiveId i) {
  { filter.excluded(i) }
  noexcept->std::convertible_to<std::span<const PrimitiveId>>;
};

/// Optional refinement of filters that list exclusions: refuses further pairs, too many to list, by a rule that is
/// cheap to ask. admits(i, j) is then in_scope(i, j) and that j is not listed with i.
template <class F>
concept ScopesPairs = ListsExclusions<F> && requires(const F& filter, PrimitiveId i, PrimitiveId j) {
  { filter.in_scope(i, j) }
  noexcept->std::same_as<bool>;
};

/// Optional refinement: can refuse all pairs of two links at once; where it does not, pairs are still asked for.
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
  std::span<const PrimitiveId> excluded(PrimitiveId) const noexcept { return {}; }
};

static_assert(ListsExclusions<AdmitAll>);

}  // namespace hinge
