// SPDX-License-Identifier: BSD-3-Clause
// PairFilter: selects the pairs of primitives that are tested. AdmitAll admits every pair.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>

#include "hinge/core/id.hpp"

namespace hinge {

/// A pure and symmetric predicate: admits(i, j) == admits(j, i). Engines call it only with i != j, and they call it for
/// every pair that comes too close. A pair counts only when admits returns true. The refinements below only save time:
/// each one gives the answer of admits for many pairs at once. hinge/policy/laws.hpp checks that the refinements agree
/// with admits. A filter between two models need not be symmetric.
template <class F>
concept PairFilter = std::copyable<F> && requires(const F& filter, PrimitiveId i, PrimitiveId j) {
  { filter.admits(i, j) }
  noexcept->std::same_as<bool>;
};

/// Optional refinement: excluded(i) lists primitives that admits rejects in a pair with i, for example bonded atoms.
/// The list is sorted and does not contain i. Engines read the lists at construction and skip the listed pairs before
/// any distance computation. admits may also reject pairs that are not listed. The span must stay valid while the
/// filter lives.
template <class F>
concept ListsExclusions = PairFilter<F> && requires(const F& filter, PrimitiveId i) {
  { filter.excluded(i) }
  noexcept->std::convertible_to<std::span<const PrimitiveId>>;
};

/// Optional refinement: admits(a, b) returns false to reject all pairs of two different links at once. When it returns
/// true, engines still call admits for each pair of primitives. If a derived class declares its own admits(PrimitiveId,
/// PrimitiveId), it hides this overload, so every pair is tested.
template <class F>
concept AdmitsLinks = PairFilter<F> && requires(const F& filter, LinkId a, LinkId b) {
  { filter.admits(a, b) }
  noexcept->std::same_as<bool>;
};

/// Optional refinement of filters and matrices: size() is the number of primitives they are made for. Hierarchy
/// compares it with the model.
template <class T>
concept KnowsSize = requires(const T& policy) {
  { policy.size() }
  noexcept->std::same_as<std::size_t>;
};

/// Optional refinement of filters that work by link: links() is the link of every primitive. Hierarchy compares it with
/// the model.
template <class F>
concept KnowsLinks = PairFilter<F> && requires(const F& filter) {
  { filter.links() }
  noexcept->std::convertible_to<std::span<const LinkId>>;
};

/// Admits every pair.
struct AdmitAll {
  /// Returns true.
  bool admits(PrimitiveId, PrimitiveId) const noexcept { return true; }
};

static_assert(PairFilter<AdmitAll> && !ListsExclusions<AdmitAll> && !AdmitsLinks<AdmitAll>);

}  // namespace hinge
