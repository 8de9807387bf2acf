// SPDX-License-Identifier: BSD-3-Clause
// Triangle: a closed triangle in space; a degenerate one is the segment or point its vertices span.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/radius_sum.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/exact/error_free.hpp"
#include "hinge/detail/exact/gap.hpp"
#include "hinge/detail/primitive/triangle_corners.hpp"
#include "hinge/detail/primitive/triangle_distance.hpp"
#include "hinge/detail/primitive/triangle_exact.hpp"
#include "hinge/detail/primitive/triangle_intersection.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge {

struct Triangle {
  Vec3 a = Vec3::Zero();
  Vec3 b = Vec3::Zero();
  Vec3 c = Vec3::Zero();

  Triangle placed(const Pose& pose) const noexcept { return {pose * a, pose * b, pose * c}; }
  Aabb bounds() const noexcept { return Aabb(a).extend(b).extend(c); }
  std::array<Vec3, 3> hull() const noexcept { return {a, b, c}; }
  double hull_radius() const noexcept { return 0.0; }
  /// Bounds hide a NaN in b or c.
  bool is_valid() const noexcept { return is_finite(a) && is_finite(b) && is_finite(c); }

  /// 0 exactly when the triangles share a point. The distance, its root, is right to 28 half ulps of the largest
  /// coordinate difference plus 16 of itself; beyond 2^512 and below 2^-537 its square leaves the range of doubles and
  /// is infinite or the smallest positive number.
  friend double squared_distance(const Triangle& p, const Triangle& q) noexcept {
    constexpr double smallest = 0x1p-1074;
    const detail::Corners x = p.hull(), y = q.hull();
    const Boxes boxes(p, q);
    if (!boxes.apart(0.0) && detail::intersect(x, y, boxes.extent())) return 0.0;
    const detail::TrianglePair pair(x, y);
    if (pair.in_window()) {
      const auto nearest = pair.nearest();
      if (pair.certain(nearest)) return std::max(nearest.squared, smallest);
    }
    return detail::nearest_in_integers(x, y).squared;
  }

  /// As squared_distance says, but right whatever the size. Positive where they are apart.
  friend double distance(const Triangle& p, const Triangle& q) noexcept {
    const double squared = squared_distance(p, q);
    if ((squared >= detail::exact::lost_squares && squared <= detail::exact::largest_square) || squared == 0.0)
      return std::sqrt(squared);
    return std::max(detail::nearest_in_integers(p.hull(), q.hull()).distance, 0x1p-1074);
  }

  /// d < m, or they share a point: the answer for the real numbers that the coordinates and m are. m >= 0.
  friend bool closer_than(const Triangle& p, const Triangle& q, double m) noexcept {
    const Boxes boxes(p, q);
    if (boxes.apart(std::max(m, 0.0))) return false;
    const detail::Corners x = p.hull(), y = q.hull();
    if (!boxes.apart(0.0) && detail::intersect(x, y, boxes.extent())) return true;
    if (!(m > 0.0)) return false;
    if (!is_finite(m)) return true;
    const detail::TrianglePair pair(x, y);
    if (pair.in_window()) {
      if (pair.planes_apart(m)) return false;
      const auto nearest = pair.nearest();
      if (nearest.distance + pair.rounding(nearest.distance) < m) return true;
      if (nearest.gap - pair.rounding(nearest.gap) >= m) return false;
    }
    return detail::closer_in_integers(x, y, {0.0, 0.0, m});
  }

  /// Of triangles grown by radii: d is below the sum of both and the clearance, or, without a clearance, not above it.
  /// The answer for the real numbers that coordinates, radii and clearance are. Finite radii, clearance >= 0.
  friend bool closer_than(const Triangle& p, const Triangle& q, const RadiusSum& reach) noexcept {
    if (reach.first == 0.0 && reach.second == 0.0) return closer_than(p, q, reach.clearance);
    // Room for the two roundings of the sum, and for one of the comparison; what is above `far` is above the sum also
    // where products are denormal.
    constexpr double sum_below = 1.0 - 4 * detail::exact::half_ulp, sum_above = 1.0 + 4 * detail::exact::half_ulp;
    const double near = reach, far = near * sum_above + 0x1p-1000;
    if (Boxes(p, q).apart(far)) return false;
    if (!is_finite(near)) return true;
    const detail::Corners x = p.hull(), y = q.hull();
    const detail::TrianglePair pair(x, y);
    if (pair.in_window()) {
      if (pair.planes_apart(far)) return false;
      const auto nearest = pair.nearest();
      if (nearest.distance + pair.rounding(nearest.distance) < near * sum_below) return true;
      if (nearest.gap - pair.rounding(nearest.gap) > far) return false;
    }
    return detail::closer_in_integers(x, y, reach);
  }

  /// As far apart as the distance says, up to an ulp or two of the coordinates; of triangles that meet, one point
  /// twice.
  friend std::pair<Vec3, Vec3> closest_points(const Triangle& p, const Triangle& q) noexcept {
    const detail::Corners x = p.hull(), y = q.hull();
    const detail::TrianglePair pair(x, y);
    if (pair.in_window()) {
      const auto nearest = pair.nearest();
      const bool disjoint = nearest.gap > pair.rounding(nearest.gap);
      if (disjoint && pair.certain(nearest)) return {pair.placed(nearest.p), pair.placed(nearest.q)};
    }
    const auto nearest = detail::nearest_in_integers(x, y);
    return {nearest.p, nearest.q};
  }

 private:
  struct Boxes {
    Boxes(const Triangle& s, const Triangle& t) noexcept : p(s.bounds()), q(t.bounds()) {}

    /// More than m apart along an axis? Exact: rounding keeps the order, so what rounds above m is above.
    bool apart(double m) const noexcept {
      bool any = false;
      for (int k = 0; k < 3; ++k) any |= p.lower[k] - q.upper[k] > m || q.lower[k] - p.upper[k] > m;
      return any;
    }
    /// The longest side of the box around both.
    double extent() const noexcept {
      double longest = 0.0;
      for (int k = 0; k < 3; ++k)
        longest = std::max(longest, std::max(p.upper[k], q.upper[k]) - std::min(p.lower[k], q.lower[k]));
      return longest;
    }
    Aabb p, q;
  };
};

static_assert(HasClosestPoints<Triangle> && HasHull<Triangle>);

}  // namespace hinge
