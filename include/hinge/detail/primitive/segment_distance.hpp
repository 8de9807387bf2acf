// SPDX-License-Identifier: BSD-3-Clause
// The distance of two segments in double arithmetic, as lower and upper bounds that include rounding.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/exact/error_free.hpp"
#include "hinge/detail/primitive/triangle_corners.hpp"
#include "hinge/detail/primitive/triangle_distance.hpp"

namespace hinge::detail {

/// Segments ab and cd in coordinates relative to a; they may be degenerate. R is the largest magnitude of these
/// coordinates. All errors below are relative to R.
class SegmentPair {
 public:
  SegmentPair(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept
      : origin_(a), x_(Vec3::Zero(), b - a), y_(c - a, d - a) {
    size_ = std::max({largest(x_.end[1]), largest(y_.end[0]), largest(y_.end[1])});
  }

  /// Returns true when products of six lengths neither overflow nor lose significant digits to underflow; false for
  /// NaN.
  bool in_window() const noexcept { return size_ >= 0x1p-150 && size_ <= 0x1p150; }

  /// Returns how much rounding may shift a bound of the distance. In half ulps of R, as vectors: 2 for the relative
  /// coordinates; for the lower bound 5 for the product of an end with a unit vector; for the upper bound 5 for an
  /// interior point of a segment; 14 for two segments. In half ulps of the distance: 5 for the root of a sum of squares
  /// and the division by the length of the direction.
  double rounding(double distance) const noexcept { return exact::half_ulp * (20 * size_ + 8 * distance); }

  struct Nearest {
    Vec3 p, q;              ///< points on the segments, up to rounding; |p - q| is an upper bound of the distance
    double distance = 0.0;  ///< |p - q|
    double gap = 0.0;  ///< separation along the best known direction: a lower bound of the distance, up to rounding
  };

  Nearest nearest() const noexcept;

  /// Returns true when the two bounds agree. The error of `distance` is then at most 28 u R + 16 u distance (u =
  /// 2^-53).
  bool certain(const Nearest& n) const noexcept {
    return n.distance - n.gap <= exact::half_ulp * (8 * size_ + 8 * n.distance);
  }
  /// Returns the error bound of a distance for which certain() holds.
  double error(double distance) const noexcept { return exact::half_ulp * (28 * size_ + 16 * distance); }

  Vec3 placed(const Vec3& local) const noexcept { return local + origin_; }

 private:
  struct Side {
    Side(const Vec3& from, const Vec3& to) noexcept : end{from, to}, way(to - from), square(squared_norm(way)) {
      inverse = square > 0.0 ? 1.0 / square : 0.0;
    }
    /// Returns the parameter in [0, 1] of the point of the segment nearest to p.
    double foot(const Vec3& p) const noexcept { return clamped(dot(Vec3(p - end[0]), way) * inverse); }
    Vec3 at(double share) const noexcept { return on_edge(end[0], end[1], share); }

    std::array<Vec3, 2> end;
    Vec3 way;
    double square = 0.0, inverse = 0.0;  // of the length; inverse is 0 when the length is 0
  };

  /// Returns the larger of min n.y - max n.x and min n.x - max n.y: the gap along n times |n|.
  double gap_times_norm(const Vec3& n) const noexcept {
    const double a = dot(n, x_.end[0]), b = dot(n, x_.end[1]), c = dot(n, y_.end[0]), d = dot(n, y_.end[1]);
    return std::max(std::min(c, d) - std::max(a, b), std::min(a, b) - std::max(c, d));
  }

  Vec3 origin_;
  Side x_, y_;
  double size_ = 0.0;
};

/// Nearest points of the two lines, clamped to the segments one after the other (Lumelsky 1985).
inline SegmentPair::Nearest SegmentPair::nearest() const noexcept {
  // Triple products keep their digits where the determinant uu vv - uv^2 cancels.
  const Vec3 w = y_.end[0] - x_.end[0], normal = cross(x_.way, y_.way);
  const double square = squared_norm(normal);
  const double start = square > exact::lost_squares ? clamped(dot(cross(w, y_.way), normal) / square) : 0.0;
  const double t = y_.foot(Vec3(x_.end[0] + x_.way * start));
  const double s = x_.foot(Vec3(y_.end[0] + y_.way * t));

  Nearest n;
  n.p = x_.at(s);
  n.q = y_.at(t);
  n.distance = std::sqrt(squared_norm(Vec3(n.p - n.q)));
  Vec3 direction = n.p - n.q;
  // The difference of near points has a large relative rounding error. Where a point is interior, use a direction that
  // is perpendicular to its segment instead.
  const bool inside_x = s > 0.0 && s<1.0, inside_y = t> 0.0 && t < 1.0;
  if (inside_x && inside_y)
    direction = square > 0.25 * x_.square * y_.square ? normal : accurate_cross(x_.way, y_.way);
  else if (inside_x)
    direction -= x_.way * (dot(direction, x_.way) * x_.inverse);
  else if (inside_y)
    direction -= y_.way * (dot(direction, y_.way) * y_.inverse);
  const double length = squared_norm(direction);
  n.gap = length > exact::lost_squares ? gap_times_norm(direction) / std::sqrt(length) : 0.0;
  return n;
}

}  // namespace hinge::detail
