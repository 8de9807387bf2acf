// SPDX-License-Identifier: BSD-3-Clause
// Yes and no come from closer_than(), which is exact; what rounding makes of the numbers is brought in line with it.
#include "closeness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hinge::robotics {

Closeness closeness(const Triangle& first, const Triangle& second, double radius1, double radius2, double threshold) {
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  const double radii = radius1 + radius2, between = std::sqrt(squared_distance(first, second));
  const bool meet = closer_than(first, second, radii);
  Closeness result;
  result.collides = closer_than(first, second, threshold);
  result.distance = meet ? 0.0 : std::max(between - radii, smallest);
  result.gap = between - threshold;
  if (result.collides && !meet) result.gap = std::min(result.gap, -smallest);
  if (!result.collides) result.gap = std::max(result.gap, 0.0);

  const auto [p, q] = closest_points(first, second);
  const Vec3 way = q - p;
  const double length = std::sqrt(squared_norm(way));
  result.point1 = p;
  result.point2 = q;
  if (meet) {
    // Divides the way as the radii do, so it is inside both.
    if (radii > 0.0) result.point1 = p + way * (radius1 / radii);
    result.point2 = result.point1;
  } else if (radii > 0.0 && length > 0.0) {
    result.point1 = p + way * (radius1 / length);
    result.point2 = q - way * (radius2 / length);
  }
  return result;
}

}  // namespace hinge::robotics
