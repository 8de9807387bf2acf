// SPDX-License-Identifier: BSD-3-Clause
// Sphere: a closed ball.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/bounds/round.hpp"
#include "hinge/detail/exact/balls.hpp"
#include "hinge/detail/exact/error_free.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge {

/// A ball. Coordinates in the frame of its link or in the world, model length unit.
struct Sphere {
  static constexpr bool fills_hull = true;  ///< see FillsHull
  Vec3 center = Vec3::Zero();               ///< model length unit
  double radius = 0.0;                      ///< >= 0, model length unit

  /// Returns the ball transformed by the pose. The radius does not change.
  Sphere placed(const Pose& pose) const noexcept { return {pose * center, radius}; }
  /// Returns true when all values are finite and the radius is >= 0.
  bool is_valid() const noexcept { return is_finite(center) && is_finite(radius) && radius >= 0.0; }
  /// Returns the center.
  std::array<Vec3, 1> hull() const noexcept { return {center}; }
  /// Returns the radius.
  double hull_radius() const noexcept { return radius; }

  /// Returns the smallest box of doubles that contains the ball: rounded outward only where a sum is inexact.
  Aabb bounds() const noexcept {
    Aabb box;
    for (int k = 0; k < 3; ++k) {
      const detail::exact::ValueAndError low = detail::exact::two_difference(center[k], radius),
                                         high = detail::exact::two_sum(center[k], radius);
      box.lower[k] = low.rest < 0.0 ? detail::next_down(low.value) : low.value;
      box.upper[k] = high.rest > 0.0 ? detail::next_up(high.value) : high.value;
    }
    return box;
  }
  /// Returns true when the center lies on the line through axis_point along the unit vector axis, up to rounding.
  bool fixed_on_axis(const Vec3& axis_point, const Vec3& axis) const noexcept {
    return Point{center}.fixed_on_axis(axis_point, axis);
  }

  /// Returns the squared surface distance, 0 exactly when the closed balls share a point. With u = 2^-53, the error of
  /// its root is at most 8 u of the largest coordinate difference plus 10 u of the root. Distances above 2^512 give
  /// infinity, below 2^-537 the smallest positive double; below 2^-511 digits are lost.
  friend double squared_distance(const Sphere& p, const Sphere& q) noexcept {
    // Roundings in units of 2^-53 of the larger term: 4 for the root of the sum of squares, 1 for the sum, 1 for the
    // difference.
    constexpr double band = 16 * detail::exact::half_ulp;
    const double touch = p.radius + q.radius, squared = squared_norm(Vec3(p.center - q.center));
    if (squared >= detail::exact::lost_squares && squared <= detail::exact::largest_square) [[likely]] {
      const double apart = std::sqrt(squared), gap = apart - touch;
      if (gap > band * apart) return gap * gap;
      if (gap < -band * touch) return 0.0;
    }
    return detail::exact::squared_gap_of_balls(p.center, q.center, {p.radius, q.radius, 0.0});
  }

  /// Returns true when the center distance is below the sum of both radii and m >= 0, or the closed balls touch. The
  /// answer is exact for the stored centers, radii and m.
  friend bool closer_than(const Sphere& p, const Sphere& q, double m) noexcept {
    // Roundings in units of 2^-53: 5 for the sum of squares including the differences, 5 for the square of a sum of
    // three, 1 for the product with the band. The comparisons are false when the left side is infinite.
    constexpr double band = 1.0 + 16 * detail::exact::half_ulp;
    const double near = p.radius + q.radius + m, square = near * near;
    const double squared = squared_norm(Vec3(p.center - q.center));
    if (square * band + detail::exact::lost_squares < squared) return false;
    if (squared * band + detail::exact::lost_squares < square) return true;
    return detail::exact::balls_closer_than(p.center, q.center, {p.radius, q.radius, m});
  }

  /// Returns points on the two surfaces, on the line of centers, up to rounding of the coordinates. Overlapping balls
  /// give the same point twice.
  friend std::pair<Vec3, Vec3> closest_points(const Sphere& p, const Sphere& q) noexcept {
    const Vec3 apart = q.center - p.center;
    const double largest = std::max({std::abs(apart[0]), std::abs(apart[1]), std::abs(apart[2])});
    if (!(largest > 0.0)) return {p.center, p.center};
    const Vec3 scaled = apart / largest;  // components in [-1, 1]: no overflow
    const double length = std::sqrt(squared_norm(scaled)), distance = length * largest;
    const Vec3 direction = scaled / length;
    const Vec3 on_p = p.center + direction * std::min(p.radius, distance);
    if (closer_than(p, q, 0.0)) return {on_p, on_p};
    return {on_p, q.center - direction * q.radius};
  }
};

static_assert(HasClosestPoints<Sphere> && HasHull<Sphere> && HasAxisInvariance<Sphere>);

}  // namespace hinge
