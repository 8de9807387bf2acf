// SPDX-License-Identifier: BSD-3-Clause
// Point: a primitive without size, such as an atom. Never solid: a pair collides when strictly d < m.
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

struct Point {
  static constexpr bool is_point_like = true;
  Vec3 position = Vec3::Zero();

  Point placed(const Pose& pose) const noexcept { return {pose * position}; }
  Aabb bounds() const noexcept { return Aabb(position); }
  std::array<Vec3, 1> hull() const noexcept { return {position}; }
  double hull_radius() const noexcept { return 0.0; }

  /// 0 exactly when the points coincide. The distance, its root, is right to 4 half ulps; beyond 2^512 and below 2^-537
  /// its square leaves the range of doubles and is infinite or the smallest positive number, and below 2^-511 it has
  /// lost digits.
  friend double squared_distance(const Point& p, const Point& q) noexcept {
    const double squared = squared_norm(Vec3(p.position - q.position));
    if (squared >= detail::exact::lost_squares) [[likely]]
      return squared;
    return detail::exact::squared_gap_of_balls(p.position, q.position, {});
  }

  /// Right to 4 half ulps, whatever the size; 0 exactly when the points coincide.
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

  /// Strictly d < m, the answer for the real numbers that coordinates and m are; never when m = 0, also for coincident
  /// points.
  friend bool closer_than(const Point& p, const Point& q, double m) noexcept {
    if (!(m > 0.0)) return false;
    // Half ulps: 5 for the sum of squares, its differences included, 1 for m * m, 1 for the product with the band. What
    // is infinite is below nothing.
    constexpr double band = 1.0 + 8 * detail::exact::half_ulp;
    const double square = m * m, squared = squared_norm(Vec3(p.position - q.position));
    if (square * band + detail::exact::lost_squares < squared) return false;
    if (squared * band + detail::exact::lost_squares < square) return true;
    return detail::exact::points_closer_than(p.position, q.position, m);
  }

  friend std::pair<Vec3, Vec3> closest_points(const Point& p, const Point& q) noexcept {
    return {p.position, q.position};
  }

  /// On the line through axis_point along the unit vector axis, up to rounding: an axis is a normalised difference of
  /// two stored points, so its end misses the line by a few 2^-53 of the coordinates involved.
  bool fixed_on_axis(const Vec3& axis_point, const Vec3& axis) const noexcept {
    // By a power of two first, which rounds nothing: squares of tiny and huge lengths leave the range of doubles.
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
