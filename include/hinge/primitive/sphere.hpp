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

struct Sphere {
  Vec3 center = Vec3::Zero();
  double radius = 0.0;  ///< >= 0

  Sphere placed(const Pose& pose) const noexcept { return {pose * center, radius}; }
  bool is_valid() const noexcept { return is_finite(center) && is_finite(radius) && radius >= 0.0; }
  std::array<Vec3, 1> hull() const noexcept { return {center}; }
  double hull_radius() const noexcept { return radius; }

  /// Rounded outward, by no more than has to be.
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
  bool fixed_on_axis(const Vec3& axis_point, const Vec3& axis) const noexcept {
    return Point{center}.fixed_on_axis(axis_point, axis);
  }

  /// 0 exactly when the closed balls share a point. The distance, its root, is right to 8 half ulps of the largest
  /// coordinate difference and 10 of itself; beyond 2^512 and below 2^-537 its square leaves the range of doubles and
  /// is infinite or the smallest positive number, and below 2^-511 it has lost digits.
  friend double squared_distance(const Sphere& p, const Sphere& q) noexcept {
    // Half ulps: of the larger, 4 for the root of squares, 1 for the sum, 1 for the difference.
    constexpr double band = 16 * detail::exact::half_ulp;
    const double touch = p.radius + q.radius, squared = squared_norm(Vec3(p.center - q.center));
    if (squared >= detail::exact::lost_squares && squared <= detail::exact::largest_square) [[likely]] {
      const double apart = std::sqrt(squared), gap = apart - touch;
      if (gap > band * apart) return gap * gap;
      if (gap < -band * touch) return 0.0;
    }
    return detail::exact::squared_gap_of_balls(p.center, q.center, {p.radius, q.radius, 0.0});
  }

  /// |c - c'| < r + r' + m, or they touch: the answer for the real numbers that centres, radii and m are. m >= 0.
  friend bool closer_than(const Sphere& p, const Sphere& q, double m) noexcept {
    // Half ulps: 5 for the sum of squares, its differences included, 5 for the square of a sum of three, 1 for the
    // product with the band. What is infinite is below nothing.
    constexpr double band = 1.0 + 16 * detail::exact::half_ulp;
    const double near = p.radius + q.radius + m, square = near * near;
    const double squared = squared_norm(Vec3(p.center - q.center));
    if (square * band + detail::exact::lost_squares < squared) return false;
    if (squared * band + detail::exact::lost_squares < square) return true;
    return detail::exact::balls_closer_than(p.center, q.center, {p.radius, q.radius, m});
  }

  /// On the surfaces along the line of centres, up to rounding of the coordinates; where the balls overlap, the same
  /// point twice.
  friend std::pair<Vec3, Vec3> closest_points(const Sphere& p, const Sphere& q) noexcept {
    const Vec3 apart = q.center - p.center;
    const double largest = std::max({std::abs(apart[0]), std::abs(apart[1]), std::abs(apart[2])});
    if (!(largest > 0.0)) return {p.center, p.center};
    const Vec3 scaled = apart / largest;  // squares of what is neither large nor small
    const double length = std::sqrt(squared_norm(scaled)), distance = length * largest;
    const Vec3 direction = scaled / length;
    const Vec3 on_p = p.center + direction * std::min(p.radius, distance);
    if (closer_than(p, q, 0.0)) return {on_p, on_p};
    return {on_p, q.center - direction * q.radius};
  }
};

static_assert(HasClosestPoints<Sphere> && HasHull<Sphere> && HasAxisInvariance<Sphere>);

}  // namespace hinge
