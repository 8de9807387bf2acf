// SPDX-License-Identifier: BSD-3-Clause
// Triangle: a closed triangle in space. A degenerate triangle is the segment or point that its corners span.
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

/// A triangle with three corners, in the frame of its link or in the world, model length unit.
struct Triangle {
  static constexpr bool fills_hull = true;  ///< see FillsHull
  Vec3 a = Vec3::Zero();                    ///< first corner
  Vec3 b = Vec3::Zero();                    ///< second corner
  Vec3 c = Vec3::Zero();                    ///< third corner

  /// Returns the triangle transformed by the pose.
  Triangle placed(const Pose& pose) const noexcept { return {pose * a, pose * b, pose * c}; }
  /// Returns the smallest box that contains the triangle.
  Aabb bounds() const noexcept { return Aabb(a).extend(b).extend(c); }
  /// Returns the three corners.
  std::array<Vec3, 3> hull() const noexcept { return {a, b, c}; }
  /// Returns 0.
  static constexpr double hull_radius() noexcept { return 0.0; }
  /// Returns true when all corners are finite. The check is needed because bounds() hides a NaN in b or c.
  bool is_valid() const noexcept { return is_finite(a) && is_finite(b) && is_finite(c); }

  /// Returns the squared distance, 0 exactly when the triangles share a point. With u = 2^-53, the error of its root is
  /// at most 28 u of the largest coordinate difference plus 16 u of the root. Distances above 2^512 give infinity,
  /// below 2^-537 the smallest positive double.
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

  /// Returns the distance with the accuracy of squared_distance, for every magnitude. It is positive for disjoint
  /// triangles.
  friend double distance(const Triangle& p, const Triangle& q) noexcept {
    const double squared = squared_distance(p, q);
    if ((squared >= detail::exact::lost_squares && squared <= detail::exact::largest_square) || squared == 0.0)
      return std::sqrt(squared);
    return std::max(detail::nearest_in_integers(p.hull(), q.hull()).distance, 0x1p-1074);
  }

  /// Returns true when d < m, or the triangles share a point. m >= 0. The answer is exact for the stored coordinates
  /// and m.
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

  /// The same for triangles inflated by radii: true when d is below the sum of both radii and the clearance or, with
  /// clearance 0, at most the sum of the radii. The answer is exact for the stored values. Radii finite, clearance >=
  /// 0.
  friend bool closer_than(const Triangle& p, const Triangle& q, const RadiusSum& reach) noexcept {
    if (reach.first == 0.0 && reach.second == 0.0) return closer_than(p, q, reach.clearance);
    // Margin for the two roundings of the sum and one rounding in the comparison. The constant in `far` keeps it above
    // the exact sum when the products are denormal.
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

  /// Returns two nearest points. Their distance matches distance() up to one or two ulps of the coordinates. Triangles
  /// that share a point give the same point twice.
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

    /// Returns true when the boxes are more than m apart along an axis. Exact: rounding is monotone, so a rounded
    /// difference above m proves an exact difference above m.
    bool apart(double m) const noexcept {
      bool any = false;
      for (int k = 0; k < 3; ++k) any |= p.lower[k] - q.upper[k] > m || q.lower[k] - p.upper[k] > m;
      return any;
    }
    /// Returns the longest side of the box around both triangles.
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
