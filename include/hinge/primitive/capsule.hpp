// SPDX-License-Identifier: BSD-3-Clause
// Capsule: all points within a radius of a segment, closed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/exact/error_free.hpp"
#include "hinge/detail/exact/segments.hpp"
#include "hinge/detail/primitive/segment_distance.hpp"
#include "hinge/detail/primitive/triangle_corners.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"

namespace hinge {

struct Capsule {
  Vec3 a = Vec3::Zero();
  Vec3 b = Vec3::Zero();
  double radius = 0.0;  ///< >= 0

  Capsule placed(const Pose& pose) const noexcept { return {pose * a, pose * b, radius}; }
  bool is_valid() const noexcept { return is_finite(a) && is_finite(b) && is_finite(radius) && radius >= 0.0; }
  Aabb bounds() const noexcept { return Sphere{a, radius}.bounds().extend(Sphere{b, radius}.bounds()); }
  std::array<Vec3, 2> hull() const noexcept { return {a, b}; }
  double hull_radius() const noexcept { return radius; }
  bool fixed_on_axis(const Vec3& axis_point, const Vec3& axis) const noexcept {
    return Point{a}.fixed_on_axis(axis_point, axis) && Point{b}.fixed_on_axis(axis_point, axis);
  }

  /// 0 exactly when the closed capsules share a point. The distance, its root, is right to 28 half ulps of the largest
  /// coordinate difference, 17 of the segments' distance and 2 of itself; beyond 2^512 and below 2^-537 its square
  /// leaves the range of doubles and is infinite or the smallest positive number, and below 2^-511 it has lost digits.
  friend double squared_distance(const Capsule& p, const Capsule& q) noexcept {
    constexpr double sum_below = 1.0 - 4 * detail::exact::half_ulp, sum_above = 1.0 + 4 * detail::exact::half_ulp;
    const double touch = p.radius + q.radius;
    const detail::SegmentPair pair(p.a, p.b, q.a, q.b);
    if (pair.in_window()) {
      const auto nearest = pair.nearest();
      if (nearest.distance + pair.rounding(nearest.distance) < touch * sum_below) return 0.0;
      if (pair.certain(nearest) && nearest.distance - pair.error(nearest.distance) > touch * sum_above) {
        const double gap = nearest.distance - touch;
        return gap * gap;
      }
    }
    return detail::exact::nearest_of_segments(p.a, p.b, q.a, q.b, {p.radius, q.radius, 0.0}).squared_gap;
  }

  /// The segments are closer than both radii and m together, or the closed capsules touch: the answer for the real
  /// numbers that coordinates, radii and m are. m >= 0.
  friend bool closer_than(const Capsule& p, const Capsule& q, double m) noexcept {
    // Room for the two roundings of the sum, and for one of the comparison.
    constexpr double sum_below = 1.0 - 4 * detail::exact::half_ulp, sum_above = 1.0 + 4 * detail::exact::half_ulp;
    const double near = p.radius + q.radius + m;
    if (apart(p, q, near * sum_above)) return false;
    const detail::SegmentPair pair(p.a, p.b, q.a, q.b);
    if (pair.in_window()) {
      const auto nearest = pair.nearest();
      if (nearest.distance + pair.rounding(nearest.distance) < near * sum_below) return true;
      if (nearest.gap - pair.rounding(nearest.gap) > near * sum_above) return false;
    }
    return detail::exact::segments_closer_than(p.a, p.b, q.a, q.b, {p.radius, q.radius, m});
  }

  /// On the surfaces along the line of the segments' nearest points, up to rounding of the coordinates; where the
  /// capsules overlap, the same point twice.
  friend std::pair<Vec3, Vec3> closest_points(const Capsule& p, const Capsule& q) noexcept {
    const detail::SegmentPair pair(p.a, p.b, q.a, q.b);
    if (pair.in_window()) {
      const auto nearest = pair.nearest();
      if (pair.certain(nearest))
        return closest_points(Sphere{pair.placed(nearest.p), p.radius}, Sphere{pair.placed(nearest.q), q.radius});
    }
    const auto nearest = detail::exact::nearest_of_segments(p.a, p.b, q.a, q.b, {p.radius, q.radius, 0.0});
    return closest_points(Sphere{detail::on_edge(p.a, p.b, nearest.s), p.radius},
                          Sphere{detail::on_edge(q.a, q.b, nearest.t), q.radius});
  }

 private:
  /// Are the boxes of the segments more than m apart along an axis? Exact: what rounds above m is above.
  static bool apart(const Capsule& p, const Capsule& q, double m) noexcept {
    bool any = false;
    for (int k = 0; k < 3; ++k)
      any |= std::min(p.a[k], p.b[k]) - std::max(q.a[k], q.b[k]) > m ||
             std::min(q.a[k], q.b[k]) - std::max(p.a[k], p.b[k]) > m;
    return any;
  }
};

static_assert(HasClosestPoints<Capsule> && HasHull<Capsule> && HasAxisInvariance<Capsule>);

}  // namespace hinge
