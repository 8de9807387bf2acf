// SPDX-License-Identifier: BSD-3-Clause
// The distance of two segments in double arithmetic, between bounds that hold whatever the rounding.
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

/// Segments ab and cd relative to a; degenerate ones are their points. R, the largest coordinate there, is the unit of
/// all errors below.
class SegmentPair {
 public:
  SegmentPair(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept
      : origin_(a), x_(Vec3::Zero(), b - a), y_(c - a, d - a) {
    size_ = std::max({largest(x_.end[1]), largest(y_.end[0]), largest(y_.end[1])});
  }

  /// Products of six lengths neither overflow nor lose digits that matter to underflow; false also for NaN.
  bool in_window() const noexcept { return size_ >= 0x1p-150 && size_ <= 0x1p150; }

  /// How far rounding may put a bound of the distance on the wrong side. In half ulps of R, as vectors: 2 for the
  /// rounding of an end to here; below it, 5 for the product of an end with a unit vector, above it, 5 for a point
  /// inside a segment; for two, 14. In half ulps of the distance: 5 for its root of squares and the division by the
  /// direction's length.
  double rounding(double distance) const noexcept { return exact::half_ulp * (20 * size_ + 8 * distance); }

  struct Nearest {
    Vec3 p, q;              ///< points of the segments, up to rounding: the distance is at most theirs
    double distance = 0.0;  ///< |p - q|
    double gap = 0.0;       ///< along the best direction known: the distance is at least this, up to rounding
  };

  Nearest nearest() const noexcept;

  /// Do the bounds agree? Then `distance` is right to 28 half ulps of R and 16 of itself.
  bool certain(const Nearest& n) const noexcept {
    return n.distance - n.gap <= exact::half_ulp * (8 * size_ + 8 * n.distance);
  }
  /// How far a certain distance may be off.
  double error(double distance) const noexcept { return exact::half_ulp * (28 * size_ + 16 * distance); }

  Vec3 placed(const Vec3& local) const noexcept { return local + origin_; }

 private:
  struct Side {
    Side(const Vec3& from, const Vec3& to) noexcept : end{from, to}, way(to - from), square(squared_norm(way)) {
      inverse = square > 0.0 ? 1.0 / square : 0.0;
    }
    /// Where the foot of p is, as a share of the way.
    double foot(const Vec3& p) const noexcept { return clamped(dot(Vec3(p - end[0]), way) * inverse); }
    Vec3 at(double share) const noexcept { return on_edge(end[0], end[1], share); }

    std::array<Vec3, 2> end;
    Vec3 way;
    double square = 0.0, inverse = 0.0;  // of the length; 0 for 0
  };

  /// (min n.y - max n.x) for the sign of n that gives more.
  double gap_times_norm(const Vec3& n) const noexcept {
    const double a = dot(n, x_.end[0]), b = dot(n, x_.end[1]), c = dot(n, y_.end[0]), d = dot(n, y_.end[1]);
    return std::max(std::min(c, d) - std::max(a, b), std::min(a, b) - std::max(c, d));
  }

  Vec3 origin_;
  Side x_, y_;
  double size_ = 0.0;
};

/// Nearest points of the lines, brought onto the segments one after the other (Lumelsky 1985).
inline SegmentPair::Nearest SegmentPair::nearest() const noexcept {
  // Triple products keep their digits where uu vv - uv^2 cancels.
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
  // A direction computed from near points is off by the rounding of these; at right angles to a segment it need not be.
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
