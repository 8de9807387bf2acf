// SPDX-License-Identifier: BSD-3-Clause
// Sphere: a closed ball.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge {

struct Sphere {
  Vec3 center = Vec3::Zero();
  double radius = 0.0;  ///< >= 0

  Sphere placed(const Pose& pose) const noexcept { return {pose * center, radius}; }
  Aabb bounds() const noexcept { return {center - Vec3::Constant(radius), center + Vec3::Constant(radius)}; }
  bool fixed_on_axis(const Vec3& axis_point, const Vec3& axis) const noexcept {
    return Point{center}.fixed_on_axis(axis_point, axis);
  }

  friend double squared_distance(const Sphere& p, const Sphere& q) noexcept {
    const double gap = std::sqrt(squared_norm(Vec3(p.center - q.center))) - (p.radius + q.radius);
    return gap > 0.0 ? gap * gap : 0.0;
  }

  /// Compares squares before any root: d < m is |c - c'| < r + r' + m; touching counts.
  friend bool closer_than(const Sphere& p, const Sphere& q, double m) noexcept {
    const double touch = p.radius + q.radius, near = touch + m;
    const double squared = squared_norm(Vec3(p.center - q.center));
    return squared < near * near || squared <= touch * touch;
  }

  /// On the surfaces along the line of centres; where the balls overlap, the same point twice.
  friend std::pair<Vec3, Vec3> closest_points(const Sphere& p, const Sphere& q) noexcept {
    const Vec3 apart = q.center - p.center;
    const double distance = std::sqrt(squared_norm(apart));
    if (!(distance > 0.0)) return {p.center, p.center};
    const Vec3 direction = apart / distance;
    const double reach = std::min(p.radius, distance);
    const Vec3 on_p = p.center + direction * reach;
    if (distance <= p.radius + q.radius) return {on_p, on_p};
    return {on_p, q.center - direction * q.radius};
  }
};

static_assert(HasClosestPoints<Sphere> && HasAxisInvariance<Sphere>);

}  // namespace hinge
