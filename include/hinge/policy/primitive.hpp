// SPDX-License-Identifier: BSD-3-Clause
// Primitive: what a thing must offer to be tested, and closer_than, the one place where a hit is decided.
#pragma once

#include <concepts>
#include <utility>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"

namespace hinge {

/// A plain value in its link's frame. Laws (tests/laws/primitive_laws.hpp): squared_distance is symmetric and >= 0;
/// bounds contain the primitive, so squared_distance >= squared gap of the bounds; distances do not change under one
/// common pose.
template <class P>
concept Primitive = std::copyable<P> && requires(const P& p, const P& q, const Pose& pose) {
  { p.placed(pose) }
  noexcept->std::same_as<P>;
  { p.bounds() }
  noexcept->std::same_as<Aabb>;
  { squared_distance(p, q) }
  noexcept->std::same_as<double>;
};

/// Optional refinement: can name the two nearest points (on p, then on q).
template <class P>
concept HasClosestPoints = Primitive<P> && requires(const P& p, const P& q) {
  { closest_points(p, q) }
  noexcept->std::same_as<std::pair<Vec3, Vec3>>;
};

/// Optional refinement: can tell that turning about the line (point, unit axis) leaves it where it is, so that its
/// distance to what lies across that joint is constant. `axis_point` in the primitive's frame.
template <class P>
concept HasAxisInvariance = Primitive<P> && requires(const P& p, const Vec3& axis_point, const Vec3& axis) {
  { p.fixed_on_axis(axis_point, axis) }
  noexcept->std::same_as<bool>;
};

/// Do p and q come closer than m (>= 0)? The rule for closed solids: d < m, or they touch (d = 0) whatever m is. A
/// primitive with a rule of its own (Point: strictly d < m) declares a hidden friend of this name, which wins.
template <Primitive P>
bool closer_than(const P& p, const P& q, double m) noexcept {
  const double squared = squared_distance(p, q);
  return squared < m * m || squared == 0.0;
}

}  // namespace hinge
