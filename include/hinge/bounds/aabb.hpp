// SPDX-License-Identifier: BSD-3-Clause
// Aabb: a closed axis-aligned box in double precision, and the signed separation of two boxes, which engines prune by.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/bounds/round.hpp"
#include "hinge/detail/exact/error_free.hpp"

namespace hinge {

/// A closed axis-aligned box, in the frame of its input points. The default box is empty (lower > upper).
struct Aabb {
  Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity());   ///< smallest coordinates, model length unit
  Vec3 upper = Vec3::Constant(-std::numeric_limits<double>::infinity());  ///< largest coordinates, model length unit

  Aabb() = default;
  /// The box of a single point.
  explicit Aabb(const Vec3& point) noexcept : lower(point), upper(point) {}
  /// The box with these corners; expects low <= high on each axis.
  Aabb(const Vec3& low, const Vec3& high) noexcept : lower(low), upper(high) {}

  /// Returns true for the default box. It compares the x axis only.
  bool is_empty() const noexcept { return !(lower[0] <= upper[0]); }

  /// Enlarges the box to contain the point. Returns *this.
  Aabb& extend(const Vec3& point) noexcept { return extend(Aabb(point)); }

  /// Enlarges the box to contain the other box. Returns *this.
  Aabb& extend(const Aabb& other) noexcept {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], other.lower[k]);
      upper[k] = std::max(upper[k], other.upper[k]);
    }
    return *this;
  }

  /// Returns true when `other` lies inside this closed box.
  bool contains(const Aabb& other) const noexcept {
    bool inside = true;
    for (int k = 0; k < 3; ++k) inside = inside && lower[k] <= other.lower[k] && other.upper[k] <= upper[k];
    return inside;
  }

  /// Returns the midpoint along axis k, as lo + (hi - lo) / 2. This form avoids the overflow of lo + hi.
  double middle(int k) const noexcept { return lower[k] + (upper[k] - lower[k]) / 2; }

  /// Returns the side length along axis k.
  double length(int k) const noexcept { return upper[k] - lower[k]; }

  /// Returns the axis (0, 1 or 2) of the longest side. On ties it returns the lowest axis.
  int widest_axis() const noexcept {
    const Vec3 size = upper - lower;
    return size[0] >= size[1] ? (size[0] >= size[2] ? 0 : 2) : (size[1] >= size[2] ? 1 : 2);
  }

  /// Returns the box enlarged by r >= 0 on every side and rounded outward. It also adds 2^-50 of the largest magnitude
  /// involved. A computed distance has an error of a few 2^-53 of its coordinates. With this margin the boxes never
  /// prune a pair whose computed distance is just below a threshold.
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

/// Returns a lower bound of d - r - s for any two primitives inside a and b, where a was inflated by r and b by s. The
/// bound is the largest signed gap along an axis. When several gaps are positive, it is their Euclidean norm, rounded
/// down. It is at most 0 when the closed boxes touch. (BioCD eq. (2)-(4): a box contains each primitive together with a
/// ball of its threshold radius. Two such balls are at least as far apart as the boxes. Along one axis the bound also
/// holds when it is negative.)
inline double separation(const Aabb& a, const Aabb& b) noexcept {
  constexpr double down = 1.0 - 0x1p-50;
  double largest = -std::numeric_limits<double>::infinity();
  double squared = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double gap = std::max(b.lower[k] - a.upper[k], a.lower[k] - b.upper[k]);
    largest = std::max(largest, gap);
    if (gap > 0.0) squared += gap * gap;
  }
  // Squares that overflow or underflow carry no information: use the axis gap instead.
  return largest > 0.0 && squared >= detail::exact::lost_squares && squared <= detail::exact::largest_square
             ? std::max(largest, std::sqrt(squared) * down)
             : largest;
}

/// Returns true when the closed boxes share a point. Branch-free: the branch is unpredictable in a sweep.
inline bool overlap(const Aabb& a, const Aabb& b) noexcept {
  bool touching = true;
  for (int k = 0; k < 3; ++k) {
    touching &= a.lower[k] <= b.upper[k];
    touching &= b.lower[k] <= a.upper[k];
  }
  return touching;
}

}  // namespace hinge
