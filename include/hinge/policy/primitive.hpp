// SPDX-License-Identifier: BSD-3-Clause
// Primitive: what a thing must offer to be tested, and closer_than, the one place where a hit is decided.
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

/// Optional refinement: lies within hull_radius() of the convex hull of a few points, hull(), so that what is known of
/// the motion of points is known of it.
template <class P>
concept HasHull = Primitive<P> && requires(const P& p) {
  { p.hull()[0] } -> std::convertible_to<Vec3>;
  { p.hull().size() } -> std::convertible_to<std::size_t>;
  { p.hull_radius() }
  noexcept->std::same_as<double>;
};

/// Is the primitive one point with a radius, an atom or a ball?
template <HasHull P>
inline constexpr bool has_one_point = std::tuple_size_v<decltype(std::declval<P>().hull())> == 1;

/// A primitive whose motion can be bounded, so that CertifiedPath can prove paths free: one point, or closest points
/// that give the direction in which to measure.
template <class P>
concept Certifiable = HasHull<P> &&(HasClosestPoints<P> || has_one_point<P>);

/// Optional refinement: can tell that turning about the line (point, unit axis) leaves it where it is, so that its
/// distance to what lies across that joint is constant. `axis_point` in the primitive's frame.
template <class P>
concept HasAxisInvariance = Primitive<P> && requires(const P& p, const Vec3& axis_point, const Vec3& axis) {
  { p.fixed_on_axis(axis_point, axis) }
  noexcept->std::same_as<bool>;
};

/// Optional refinement: can tell what its bounds may hide: a coordinate that is no number beside others that are, a
/// negative radius. True of a value that distances can be asked of.
template <class P>
concept ChecksItself = Primitive<P> && requires(const P& p) {
  { p.is_valid() }
  noexcept->std::same_as<bool>;
};

/// Can distances of p be asked for: is it valid, and are its bounds lengths, and not empty? Asked about every primitive
/// that is placed elsewhere.
template <Primitive P>
bool is_sound(const P& p) noexcept {
  const Aabb box = p.bounds();
  const bool holds = box.lower[0] <= box.upper[0] && box.lower[1] <= box.upper[1] && box.lower[2] <= box.upper[2];
  if (!holds || !is_length(box.lower) || !is_length(box.upper)) return false;
  if constexpr (ChecksItself<P>) return p.is_valid();
  return true;
}

/// What is wrong with a p that is not sound, to be put behind its name.
template <Primitive P>
const char* flaw_of(const P& p) noexcept {
  if constexpr (ChecksItself<P>)
    if (!p.is_valid()) return "not finite, or of negative size";
  const Aabb box = p.bounds();
  if (!is_length(box.lower) || !is_length(box.upper)) return "its bounds are not finite, or beyond 2^1000";
  return "its bounds are empty";
}

/// Optional refinement: nothing comes closer than 0 to it, not even what lies in the same place (BioCD's atoms:
/// strictly d < M). Where its thresholds are all 0 it never collides, and engines may pass it over.
template <class P>
concept IsPointLike = Primitive<P> && requires {
  requires P::is_point_like;
};

/// Do p and q come closer than m (>= 0)? The rule for closed solids: d < m, or they touch (d = 0) whatever m is. A
/// primitive with a rule of its own (Point: strictly d < m) declares a hidden friend of this name, which wins.
template <Primitive P>
bool closer_than(const P& p, const P& q, double m) noexcept {
  const double squared = squared_distance(p, q);
  return squared < m * m || squared == 0.0;
}

/// d(p, q) in the model's length unit. A primitive whose squared distance may leave the range of doubles declares a
/// hidden friend of this name, which wins.
template <Primitive P>
double distance(const P& p, const P& q) noexcept {
  return std::sqrt(squared_distance(p, q));
}

}  // namespace hinge
