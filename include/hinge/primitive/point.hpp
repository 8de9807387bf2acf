// SPDX-License-Identifier: BSD-3-Clause
// Point: a primitive without size, such as an atom. Never solid: a pair collides when strictly d < m.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge {

struct Point {
  Vec3 position = Vec3::Zero();

  Point placed(const Pose& pose) const noexcept { return {pose * position}; }
  Aabb bounds() const noexcept { return Aabb(position); }

  friend double squared_distance(const Point& p, const Point& q) noexcept {
    return squared_norm(Vec3(p.position - q.position));
  }

  /// Strictly d < m; never when m = 0, also for coincident points. Squares leave the range of doubles beyond about
  /// 1e154 and below 1e-154: there both sides are scaled by a power of two, which changes no comparison.
  friend bool closer_than(const Point& p, const Point& q, double m) noexcept {
    constexpr double large = 0x1p400, small = 0x1p-400;
    const Vec3 d = p.position - q.position;
    const double square = m * m, squared = squared_norm(d);
    if (square <= large && square >= small && squared <= large) return squared < square;
    const double scale = std::max({m, std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
    if (!(m > 0.0)) return false;
    int exponent = 0;
    std::frexp(scale, &exponent);
    const Vec3 e(std::ldexp(d[0], -exponent), std::ldexp(d[1], -exponent), std::ldexp(d[2], -exponent));
    const double n = std::ldexp(m, -exponent);
    return squared_norm(e) < n * n;
  }

  friend std::pair<Vec3, Vec3> closest_points(const Point& p, const Point& q) noexcept {
    return {p.position, q.position};
  }

  /// On the line through axis_point along the unit vector axis, up to rounding: an axis is a normalised difference of
  /// two stored points, so its end misses the line by a few 2^-53 of the coordinates involved.
  bool fixed_on_axis(const Vec3& axis_point, const Vec3& axis) const noexcept {
    const double size = std::sqrt(squared_norm(position)) + std::sqrt(squared_norm(axis_point));
    const double off = 16 * 0x1p-53 * size;
    return squared_norm(cross(Vec3(position - axis_point), axis)) <= off * off;
  }
};

static_assert(HasClosestPoints<Point> && HasAxisInvariance<Point>);

}  // namespace hinge
