// SPDX-License-Identifier: BSD-3-Clause
// Capsule: all points within a radius of a segment, closed.
#pragma once

#include <cmath>
#include <utility>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/segment_distance.hpp"
#include "hinge/primitive/sphere.hpp"

namespace hinge {

struct Capsule {
  Vec3 a = Vec3::Zero();
  Vec3 b = Vec3::Zero();
  double radius = 0.0;  ///< >= 0

  Capsule placed(const Pose& pose) const noexcept { return {pose * a, pose * b, radius}; }
  Aabb bounds() const noexcept { return Sphere{a, radius}.bounds().extend(Sphere{b, radius}.bounds()); }
  bool fixed_on_axis(const Vec3& axis_point, const Vec3& axis) const noexcept {
    return Point{a}.fixed_on_axis(axis_point, axis) && Point{b}.fixed_on_axis(axis_point, axis);
  }

  friend double squared_distance(const Capsule& p, const Capsule& q) noexcept {
    const double gap = std::sqrt(nearest(p.a, p.b, q.a, q.b).squared) - (p.radius + q.radius);
    return gap > 0.0 ? gap * gap : 0.0;
  }

  /// On the surfaces along the line of the segments' nearest points; where the capsules overlap, the same point twice.
  friend std::pair<Vec3, Vec3> closest_points(const Capsule& p, const Capsule& q) noexcept {
    const NearestPair on_segments = nearest(p.a, p.b, q.a, q.b);
    return closest_points(Sphere{on_segments.first, p.radius}, Sphere{on_segments.second, q.radius});
  }
};

static_assert(HasClosestPoints<Capsule> && HasAxisInvariance<Capsule>);

}  // namespace hinge
