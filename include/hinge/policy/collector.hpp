// SPDX-License-Identifier: BSD-3-Clause
// Hit, and Collector: a query mode receives the pairs that an engine finds.
#pragma once

#include <concepts>

#include "hinge/core/id.hpp"

namespace hinge {

/// A reported pair: a collision, or a near pair in the query modes that return near pairs. In self queries first <
/// second. Between two models `first` belongs to the queried model and `second` to the other model. Lengths in the
/// model's unit.
struct Hit {
  PrimitiveId first{};     ///< first primitive
  PrimitiveId second{};    ///< second primitive
  double distance = 0.0;   ///< d of BioCD eq. (1); 0 when solids touch or overlap
  double threshold = 0.0;  ///< M of BioCD eq. (1), plus the query's extra clearances of the two groups

  /// Returns distance - threshold, in the model's length unit. It is negative when the pair collides.
  double gap() const noexcept { return distance - threshold; }

  /// Returns true when all four values are equal.
  friend bool operator==(const Hit&, const Hit&) = default;
};

/// cutoff(): the collector accepts only pairs with d - M up to this value (model length unit). It must never grow.
/// done(): true when the collector needs no more pairs. `ranks` selects the pairs that the leaf kernel passes to add().
/// false: pairs accepted by closer_than(p, q, M + cutoff). true: pairs with d - M <= cutoff().
template <class C>
concept Collector = requires(C& collector, const C& constant, const Hit& hit) {
  collector.add(hit);
  { constant.cutoff() }
  noexcept->std::same_as<double>;
  { constant.done() }
  noexcept->std::same_as<bool>;
  { C::ranks } -> std::convertible_to<bool>;
};

/// Returns true when the query reports collisions only: no ranking and zero margin.
template <Collector C>
bool asks_collisions(const C& collector) noexcept {
  return !C::ranks && collector.cutoff() == 0.0;
}

/// Optional refinement: the collector is done after its first hit. Any hit is a valid answer.
template <class C>
concept StopsAtFirst = Collector<C> && requires {
  requires C::stops_at_first;
};

/// Optional refinement of collectors that rank: only the pair with the smallest d - M matters. An upper bound from one
/// pair may then rule out other pairs before they reach add().
template <class C>
concept KeepsSmallest = Collector<C> && C::ranks && requires {
  requires C::keeps_smallest;
};

/// Optional refinement: wants(a, b) returns false for pairs of links that need no more hits. Within one query a
/// rejected pair of links must stay rejected.
template <class C>
concept RefusesLinks = Collector<C> && requires(const C& collector, LinkId a, LinkId b) {
  { collector.wants(a, b) }
  noexcept->std::same_as<bool>;
};

/// Optional refinement of collectors that do not rank: of each pair of links only the pair with the smallest d - M
/// matters. smallest(a, b): the smallest d - M that add() has received for this pair of links, infinity before the
/// first. An engine may leave out pairs of primitives above it.
template <class C>
concept KeepsSmallestOfLinks = Collector<C> && !C::ranks && requires(const C& collector, LinkId a, LinkId b) {
  { collector.smallest(a, b) }
  noexcept->std::same_as<double>;
};

}  // namespace hinge
