// SPDX-License-Identifier: BSD-3-Clause
// Measures a pair of triangles. closer_than() decides exactly; the rounded numbers are adjusted to agree with it.
#include "checking/closeness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hinge/core/finite.hpp"

namespace hinge::robotics {

namespace {

/// A power of two. Squares of lengths scaled by it stay in the range of doubles.
constexpr double small = 0x1p-500;

Triangle shrunk(const Triangle& t) { return {t.a * small, t.b * small, t.c * small}; }

/// Distance and nearest points; the squares of the lengths may overflow.
struct Nearest {
  double distance = 0.0;
  Vec3 p, q;
};

Nearest nearest(const Triangle& first, const Triangle& second) {
  const double squared = squared_distance(first, second);
  if (is_finite(squared)) {
    const auto [p, q] = closest_points(first, second);
    return {std::sqrt(squared), p, q};
  }
  const Triangle x = shrunk(first), y = shrunk(second);
  const auto [p, q] = closest_points(x, y);
  return {std::sqrt(squared_distance(x, y)) / small, p / small, q / small};
}

}  // namespace

Closeness closeness(const Triangle& first, const Triangle& second, const RadiusSum& sum) {
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  const double radii = sum.first + sum.second;
  const auto [between, p, q] = nearest(first, second);
  const bool meet = closer_than(first, second, RadiusSum{sum.first, sum.second, 0.0});
  Closeness result;
  result.collides = closer_than(first, second, sum);
  result.distance = meet ? 0.0 : std::max(between - radii, smallest);
  result.gap = between - sum;
  if (result.collides && !meet) result.gap = std::min(result.gap, -smallest);
  if (!result.collides) result.gap = std::max(result.gap, 0.0);

  const Vec3 way = q - p;
  const double plain = std::sqrt(squared_norm(way));
  const double length = is_finite(plain) ? plain : std::sqrt(squared_norm(way * small)) / small;
  result.point1 = p;
  result.point2 = q;
  if (meet) {
    // Divides the segment in the ratio of the radii, so the point is inside both.
    if (radii > 0.0) result.point1 = p + way * (sum.first / radii);
    result.point2 = result.point1;
  } else if (radii > 0.0 && length > 0.0) {
    result.point1 = p + way * (sum.first / length);
    result.point2 = q - way * (sum.second / length);
  }
  return result;
}

}  // namespace hinge::robotics
