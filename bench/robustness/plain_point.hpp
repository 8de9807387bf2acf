// SPDX-License-Identifier: BSD-3-Clause
// PlainPoint: Point with decisions by one comparison in double and the same kernels, the baseline of exact decisions.
#pragma once

#include <array>
#include <utility>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/primitive/batch.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge::bench {

/// A point with plain double decisions.
struct PlainPoint {
  Point point;
  static constexpr bool fills_hull = true, is_point_like = true;  ///< as Point: the same kernels

  PlainPoint placed(const Pose& pose) const noexcept { return {point.placed(pose)}; }
  Aabb bounds() const noexcept { return point.bounds(); }
  std::array<Vec3, 1> hull() const noexcept { return point.hull(); }
  static constexpr double hull_radius() noexcept { return 0.0; }
  bool fixed_on_axis(const Vec3& axis_point, const Vec3& axis) const noexcept {
    return point.fixed_on_axis(axis_point, axis);
  }

  friend double squared_distance(const PlainPoint& p, const PlainPoint& q) noexcept {
    return squared_norm(Vec3(p.point.position - q.point.position));
  }
  friend bool closer_than(const PlainPoint& p, const PlainPoint& q, double m) noexcept {
    return squared_distance(p, q) < m * m;
  }
  friend std::pair<Vec3, Vec3> closest_points(const PlainPoint& p, const PlainPoint& q) noexcept {
    return {p.point.position, q.point.position};
  }
};

static_assert(HasClosestPoints<PlainPoint> && detail::TransformsBatch<PlainPoint>);

}  // namespace hinge::bench
