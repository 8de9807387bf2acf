// SPDX-License-Identifier: BSD-3-Clause
// Point: a primitive without size, for example an atom. A pair of points collides when strictly d < m.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/exact/balls.hpp"
#include "hinge/detail/exact/error_free.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge {

/// One point. Coordinates in the frame of its link or in the world, model length unit.
struct Point {
  static constexpr bool fills_hull = true;     ///< see FillsHull
  static constexpr bool is_point_like = true;  ///< coincident points collide only when m > 0
  Vec3 position = Vec3::Zero();                ///< model length unit

  /// Returns the point transformed by the pose.
  Point placed(const Pose& pose) const noexcept { return {pose * position}; }
  /// Returns the box that contains exactly this point.
  Aabb bounds() const noexcept { return Aabb(position); }
  /// Returns the point itself.
  std::array<Vec3, 1> hull() const noexcept { return {position}; }
  /// Returns 0.
  static constexpr double hull_radius() noexcept { return 0.0; }

  /// Returns the squared distance, 0 exactly when the points coincide. The relative error of its root is at most 4 u (u
  /// = 2^-53). Distances above 2^512 give infinity, below 2^-537 the smallest positive double; below 2^-511 digits are
  /// lost.
  friend double squared_distance(const Point& p, const Point& q) noexcept {
    const double squared = squared_norm(Vec3(p.position - q.position));
    if (squared >= detail::exact::lost_squares) [[likely]]
      return squared;
    return detail::exact::squared_gap_of_balls(p.position, q.position, {});
  }

  /// Returns the distance, with a relative error of at most 4 u (u = 2^-53) for every magnitude; 0 exactly when the
  /// points coincide.
  friend double distance(const Point& p, const Point& q) noexcept {
    const Vec3 d = p.position - q.position;
    const double squared = squared_norm(d);
    if (squared >= detail::exact::lost_squares && squared <= detail::exact::largest_square) [[likely]]
      return std::sqrt(squared);
    int exponent = 0;
    std::frexp(std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}), &exponent);
    Vec3 scaled;
    for (int k = 0; k < 3; ++k) scaled[k] = std::ldexp(d[k], -exponent);
    return std::ldexp(std::sqrt(squared_norm(scaled)), exponent);
  }

  /// Returns true when strictly d < m. The answer is exact for the stored coordinates and m. It is false for m = 0,
  /// also for coincident points.
  friend bool closer_than(const Point& p, const Point& q, double m) noexcept {
    if (!(m > 0.0)) return false;
    // Roundings in units of 2^-53: 5 for the sum of squares including the differences, 1 for m * m, 1 for the product
    // with the band. The comparisons are false when the left side is infinite.
    constexpr double band = 1.0 + 8 * detail::exact::half_ulp;
    const double square = m * m, squared = squared_norm(Vec3(p.position - q.position));
    if (square * band + detail::exact::lost_squares < squared) return false;
    if (squared * band + detail::exact::lost_squares < square) return true;
    return detail::exact::points_closer_than(p.position, q.position, m);
  }

  /// Returns the two positions.
  friend std::pair<Vec3, Vec3> closest_points(const Point& p, const Point& q) noexcept {
    return {p.position, q.position};
  }

  /// Returns true when the point lies on the line through axis_point along the unit vector axis, up to rounding. A
  /// stored axis is a normalised difference of two points, so its far end misses the line by a few 2^-53 of the
  /// coordinates involved.
  bool fixed_on_axis(const Vec3& axis_point, const Vec3& axis) const noexcept {
    // Scale by a power of two first, which is exact: squares of tiny and huge lengths would underflow or overflow.
    int exponent = 0;
    double largest = 0.0;
    for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(position[k]), std::abs(axis_point[k])});
    std::frexp(largest, &exponent);
    Vec3 p, o;
    for (int k = 0; k < 3; ++k) {
      p[k] = std::ldexp(position[k], -exponent);
      o[k] = std::ldexp(axis_point[k], -exponent);
    }
    const double off = 16 * 0x1p-53 * (norm(p) + norm(o));
    return squared_norm(cross(Vec3(p - o), axis)) <= off * off;
  }
};

static_assert(HasClosestPoints<Point> && HasHull<Point> && HasAxisInvariance<Point>);

}  // namespace hinge
