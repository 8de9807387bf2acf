// SPDX-License-Identifier: BSD-3-Clause
// Hit, and Collector: what a query mode does with the pairs an engine finds.
#pragma once

#include <concepts>

#include "hinge/core/id.hpp"

namespace hinge {

/// A pair that comes too close (or, in the modes that ask for it, close). In self queries first < second; between two
/// models `first` belongs to the model asked and `second` to the other one. Lengths in the model's unit.
struct Hit {
  PrimitiveId first{};
  PrimitiveId second{};
  double distance = 0.0;
  double threshold = 0.0;  ///< M of BioCD eq. (1), plus the extra clearances of the two groups where a query gave any

  /// Surface distance: negative when the pair collides.
  double gap() const noexcept { return distance - threshold; }

  friend bool operator==(const Hit&, const Hit&) = default;
};

/// cutoff(): pairs with d - M beyond it are no longer wanted; never grows. done(): nothing more is wanted. `ranks`
/// tells how the leaf kernel hands pairs over: false, only those that closer_than(p, q, M + cutoff) accepts; true,
/// every pair that boxes could not rule out, and the collector itself compares d - M.
template <class C>
concept Collector = requires(C& collector, const C& constant, const Hit& hit) {
  collector.add(hit);
  { constant.cutoff() }
  noexcept->std::same_as<double>;
  { constant.done() }
  noexcept->std::same_as<bool>;
  { C::ranks } -> std::convertible_to<bool>;
};

/// Are collisions asked for, with no margin?
template <Collector C>
bool asks_collisions(const C& collector) noexcept {
  return !C::ranks && collector.cutoff() == 0.0;
}

/// Optional refinement: done at the first hit, which may be any.
template <class C>
concept StopsAtFirst = Collector<C> && requires {
  requires C::stops_at_first;
};

/// Optional refinement of collectors that rank: only the pair with the smallest d - M is of interest, so that an upper
/// bound of one pair rules out others before any is handed over.
template <class C>
concept KeepsSmallest = Collector<C> && C::ranks && requires {
  requires C::keeps_smallest;
};

/// Optional refinement: is told by how much a distance that was only measured may be off (QueryOptions::precision).
template <class C>
concept TakesErrors = Collector<C> && requires(C& collector, const Hit& hit, double error) {
  collector.add_measured(hit, error);
};

/// Optional refinement: knows pairs of links of which it wants no more. What it refuses it keeps refusing in the same
/// query.
template <class C>
concept RefusesLinks = Collector<C> && requires(const C& collector, LinkId a, LinkId b) {
  { collector.wants(a, b) }
  noexcept->std::same_as<bool>;
};

}  // namespace hinge
