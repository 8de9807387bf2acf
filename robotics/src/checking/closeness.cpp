// SPDX-License-Identifier: BSD-3-Clause
// Measures a pair of triangles. closer_than() decides exactly; the rounded numbers are adjusted to agree with it.
#include "checking/closeness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hinge/core/finite.hpp"

namespace hinge::robotics {

namespace {

/// A power of two. Squares of lengths scaled by it stay in the range of doubles.
constexpr double small = 0x1p-500;

Triangle shrunk(const Triangle& t) { return {t.a * small, t.b * small, t.c * small}; }

bool overflows(const Triangle& first, const Triangle& second) { return !is_finite(squared_distance(first, second)); }

double distance_of(const Triangle& first, const Triangle& second) {
  return overflows(first, second) ? std::sqrt(squared_distance(shrunk(first), shrunk(second))) / small
                                  : std::sqrt(squared_distance(first, second));
}

std::pair<Vec3, Vec3> points_of(const Triangle& first, const Triangle& second) {
  if (!overflows(first, second)) {
    const auto [p, q] = closest_points(first, second);
    return {p, q};
  }
  const auto [p, q] = closest_points(shrunk(first), shrunk(second));
  return {p / small, q / small};
}

}  // namespace

Closeness closeness(const Triangle& first, const Triangle& second, const RadiusSum& sum) {
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  const double radii = sum.first + sum.second, between = distance_of(first, second);
  const bool meet = closer_than(first, second, RadiusSum{sum.first, sum.second, 0.0});
  Closeness result;
  result.collides = closer_than(first, second, sum);
  result.distance = meet ? 0.0 : std::max(between - radii, smallest);
  result.gap = between - sum;
  if (result.collides && !meet) result.gap = std::min(result.gap, -smallest);
  if (!result.collides) result.gap = std::max(result.gap, 0.0);

  const auto [p, q] = points_of(first, second);
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
