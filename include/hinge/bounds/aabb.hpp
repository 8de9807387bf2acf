// SPDX-License-Identifier: BSD-3-Clause
// Axis-aligned boxes, closed, in double, and the one number engines prune by: their signed separation.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/bounds/round.hpp"
#include "hinge/detail/exact/error_free.hpp"

namespace hinge {

/// A closed axis-aligned box, in the frame of the points it was made of. The default is empty (lower > upper).
struct Aabb {
  Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 upper = Vec3::Constant(-std::numeric_limits<double>::infinity());

  Aabb() = default;
  explicit Aabb(const Vec3& point) noexcept : lower(point), upper(point) {}
  Aabb(const Vec3& low, const Vec3& high) noexcept : lower(low), upper(high) {}

  bool is_empty() const noexcept { return !(lower[0] <= upper[0]); }

  Aabb& extend(const Vec3& point) noexcept { return extend(Aabb(point)); }

  Aabb& extend(const Aabb& other) noexcept {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], other.lower[k]);
      upper[k] = std::max(upper[k], other.upper[k]);
    }
    return *this;
  }

  bool contains(const Aabb& other) const noexcept {
    bool inside = true;
    for (int k = 0; k < 3; ++k) inside = inside && lower[k] <= other.lower[k] && other.upper[k] <= upper[k];
    return inside;
  }

  /// Midpoint along axis k, without overflow: lo + (hi - lo) / 2.
  double middle(int k) const noexcept { return lower[k] + (upper[k] - lower[k]) / 2; }

  double length(int k) const noexcept { return upper[k] - lower[k]; }

  int widest_axis() const noexcept {
    const Vec3 size = upper - lower;
    return size[0] >= size[1] ? (size[0] >= size[2] ? 0 : 2) : (size[1] >= size[2] ? 1 : 2);
  }

  /// The box grown by r >= 0 on every side, rounded outward. Grows by a further 2^-50 of the largest magnitude
  /// involved, so that a pair whose *computed* distance falls just below a threshold is never pruned by exact boxes: a
  /// computed distance is off by at most a few 2^-53 of the coordinates it came from.
  Aabb inflated(double r) const noexcept {
    constexpr double slack = 0x1p-50;
    Aabb grown;
    for (int k = 0; k < 3; ++k) {
      const double more = r + slack * (std::max(std::abs(lower[k]), std::abs(upper[k])) + r);
      grown.lower[k] = detail::next_down(lower[k] - more);
      grown.upper[k] = detail::next_up(upper[k] + more);
    }
    return grown;
  }
};

/// A lower bound of d - r - s for any two things held by a and b, when a was inflated by r and b by s: the largest
/// signed gap along an axis, and where several gaps are positive their Euclidean norm, rounded down. At most 0 when the
/// closed boxes touch. (BioCD eq. (2)-(4): each thing lies with a ball of its reach inside its box; two balls are at
/// least as far apart as the boxes, and along one axis the bound also holds when it is negative.)
inline double separation(const Aabb& a, const Aabb& b) noexcept {
  constexpr double down = 1.0 - 0x1p-50;
  double largest = -std::numeric_limits<double>::infinity();
  double squared = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double gap = std::max(b.lower[k] - a.upper[k], a.lower[k] - b.upper[k]);
    largest = std::max(largest, gap);
    if (gap > 0.0) squared += gap * gap;
  }
  // Squares beyond the range of doubles say nothing.
  return largest > 0.0 && squared >= detail::exact::lost_squares && squared <= detail::exact::largest_square
             ? std::max(largest, std::sqrt(squared) * down)
             : largest;
}

/// Do the closed boxes share a point? Without branches: in a sweep the answer cannot be foretold.
inline bool overlap(const Aabb& a, const Aabb& b) noexcept {
  bool touching = true;
  for (int k = 0; k < 3; ++k) {
    touching &= a.lower[k] <= b.upper[k];
    touching &= b.lower[k] <= a.upper[k];
  }
  return touching;
}

}  // namespace hinge
