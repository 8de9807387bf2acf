// SPDX-License-Identifier: BSD-3-Clause
// Primitive: the requirements on a shape, and closer_than, the single place where collisions are decided.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <tuple>
#include <utility>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"

namespace hinge {

/// A value type in the frame of its link. placed(pose) returns it transformed by the pose; bounds() returns a box in
/// the same frame. Laws (hinge/policy/laws.hpp): squared_distance is symmetric and >= 0. The bounds contain the
/// primitive, so squared_distance >= squared gap of the bounds. Distances do not change under a common pose.
template <class P>
concept Primitive = std::copyable<P> && requires(const P& p, const P& q, const Pose& pose) {
  { p.placed(pose) }
  noexcept->std::same_as<P>;
  { p.bounds() }
  noexcept->std::same_as<Aabb>;
  { squared_distance(p, q) }
  noexcept->std::same_as<double>;
};

/// Optional refinement: closest_points(p, q) returns the two nearest points, first on p, then on q.
template <class P>
concept HasClosestPoints = Primitive<P> && requires(const P& p, const P& q) {
  { closest_points(p, q) }
  noexcept->std::same_as<std::pair<Vec3, Vec3>>;
};

/// Optional refinement: the primitive lies within hull_radius() of the convex hull of a few points, hull(), an array.
/// The hull moves with the primitive, and the radius does not change. Motion bounds of these points then hold for the
/// whole primitive. If there are one or two points, engine/simd filters pairs by the distance of their hulls, sixteen
/// at a time; other primitives are filtered by their boxes.
template <class P>
concept HasHull = Primitive<P> && requires(const P& p) {
  { p.hull()[0] } -> std::convertible_to<Vec3>;
  { p.hull().size() } -> std::convertible_to<std::size_t>;
  { p.hull_radius() }
  noexcept->std::same_as<double>;
};

/// The number of points of a hull.
template <HasHull P>
inline constexpr std::size_t hull_size = std::tuple_size_v<decltype(std::declval<const P&>().hull())>;

/// Optional refinement: hull_radius() is a constant, 0.
template <class P>
concept HasSharpHull = HasHull<P> && requires {
  requires P::hull_radius()
  == 0.0;
};

/// Optional refinement: the primitive is all points within hull_radius() of the convex hull of hull(), and not only a
/// part of them.
template <class P>
concept FillsHull = HasHull<P> && requires {
  requires P::fills_hull;
};

/// A primitive with bounded motion, as CertifiedPath requires: its hull is a single point, or it has closest points,
/// which give a direction to measure in.
template <class P>
concept Certifiable = HasHull<P> &&(HasClosestPoints<P> || hull_size<P> == 1);

/// Optional refinement: returns true when a rotation about the line (axis_point, unit axis) maps the primitive onto
/// itself. Its distance to anything across that joint is then constant. Point and axis in the primitive's frame.
template <class P>
concept HasAxisInvariance = Primitive<P> && requires(const P& p, const Vec3& axis_point, const Vec3& axis) {
  { p.fixed_on_axis(axis_point, axis) }
  noexcept->std::same_as<bool>;
};

/// Optional refinement: detects errors that the bounds may hide, for example a NaN in one of several vertices or a
/// negative radius. Returns true for a value with well-defined distances.
template <class P>
concept ChecksItself = Primitive<P> && requires(const P& p) {
  { p.is_valid() }
  noexcept->std::same_as<bool>;
};

/// Returns true when distances of p are well defined: p is valid, and its bounds are lengths and not empty. Model
/// builders and update_placed check every primitive with it.
template <Primitive P>
bool is_sound(const P& p) noexcept {
  const Aabb box = p.bounds();
  const bool holds = box.lower[0] <= box.upper[0] && box.lower[1] <= box.upper[1] && box.lower[2] <= box.upper[2];
  if (!holds || !is_length(box.lower) || !is_length(box.upper)) return false;
  if constexpr (ChecksItself<P>) return p.is_valid();
  return true;
}

/// Returns the reason why p is not sound, for an error message after the name of p.
template <Primitive P>
const char* flaw_of(const P& p) noexcept {
  if constexpr (ChecksItself<P>)
    if (!p.is_valid()) return "not finite, or of negative size";
  const Aabb box = p.bounds();
  if (!is_length(box.lower) || !is_length(box.upper)) return "its bounds are not finite, or beyond 2^1000";
  return "its bounds are empty";
}

/// Optional refinement: the primitive is a point (BioCD's atoms). A pair collides only when strictly d < M, also when
/// both coincide. A primitive whose thresholds are all 0 never collides, and engines may skip it.
template <class P>
concept IsPointLike = Primitive<P> && requires {
  requires P::is_point_like;
};

/// Returns true when p and q are closer than m (>= 0, model length unit). This is the rule for closed solids: d < m, or
/// d = 0 for any m. A primitive with another rule (Point: strictly d < m) declares a hidden friend of this name, which
/// overload resolution prefers.
template <Primitive P>
bool closer_than(const P& p, const P& q, double m) noexcept {
  const double squared = squared_distance(p, q);
  return squared < m * m || squared == 0.0;
}

/// Returns d(p, q) in the model's length unit. A primitive whose squared distance may overflow or underflow declares a
/// hidden friend of this name, which overload resolution prefers.
template <Primitive P>
double distance(const P& p, const P& q) noexcept {
  return std::sqrt(squared_distance(p, q));
}

}  // namespace hinge
