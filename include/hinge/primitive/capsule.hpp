// SPDX-License-Identifier: BSD-3-Clause
// Capsule: a closed solid of all points within a radius of a segment.
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

/// A capsule with axis from a to b. Coordinates in the frame of its link or in the world, model length unit.
struct Capsule {
  static constexpr bool fills_hull = true;  ///< see FillsHull
  Vec3 a = Vec3::Zero();                    ///< one end of the axis
  Vec3 b = Vec3::Zero();                    ///< other end of the axis
  double radius = 0.0;                      ///< >= 0, model length unit

  /// Returns the capsule transformed by the pose. The radius does not change.
  Capsule placed(const Pose& pose) const noexcept { return {pose * a, pose * b, radius}; }
  /// Returns true when all values are finite and the radius is >= 0.
  bool is_valid() const noexcept { return is_finite(a) && is_finite(b) && is_finite(radius) && radius >= 0.0; }
  /// Returns a box that contains the capsule, rounded outward.
  Aabb bounds() const noexcept { return Sphere{a, radius}.bounds().extend(Sphere{b, radius}.bounds()); }
  /// Returns the two ends of the axis.
  std::array<Vec3, 2> hull() const noexcept { return {a, b}; }
  /// Returns the radius.
  double hull_radius() const noexcept { return radius; }
  /// Returns true when both ends lie on the line through axis_point along the unit vector axis, up to rounding.
  bool fixed_on_axis(const Vec3& axis_point, const Vec3& axis) const noexcept {
    return Point{a}.fixed_on_axis(axis_point, axis) && Point{b}.fixed_on_axis(axis_point, axis);
  }

  /// Returns the squared surface distance, 0 exactly when the closed capsules share a point. With u = 2^-53, the error
  /// of its root is at most 28 u of the largest coordinate difference, plus 17 u of the axis distance, plus 2 u of the
  /// root. Distances above 2^512 give infinity, below 2^-537 the smallest positive double; below 2^-511 digits are
  /// lost.
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

  /// Returns true when the axis distance is below the sum of both radii and m >= 0, or the closed capsules touch. The
  /// answer is exact for the stored coordinates, radii and m.
  friend bool closer_than(const Capsule& p, const Capsule& q, double m) noexcept {
    // Margin for the two roundings of the sum and one rounding in the comparison.
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

  /// Returns points on the two surfaces, on the line through the nearest points of the axes, up to rounding of the
  /// coordinates. Overlapping capsules give the same point twice.
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
  /// Returns true when the boxes of the axes are more than m apart along one coordinate axis. Exact: rounding is
  /// monotone, so a rounded difference above m proves an exact difference above m.
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
