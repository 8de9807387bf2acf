// SPDX-License-Identifier: BSD-3-Clause
// Yes and no come from closer_than(), which is exact; what rounding makes of the numbers is brought in line with it.
#include "closeness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hinge::robotics {

Closeness closeness(const Triangle& first, const Triangle& second, const exact::Reach& sum) {
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  const double radii = sum.first + sum.second, between = std::sqrt(squared_distance(first, second));
  const bool meet = closer_than(first, second, exact::Reach{sum.first, sum.second, 0.0});
  Closeness result;
  result.collides = closer_than(first, second, sum);
  result.distance = meet ? 0.0 : std::max(between - radii, smallest);
  result.gap = between - sum;
  if (result.collides && !meet) result.gap = std::min(result.gap, -smallest);
  if (!result.collides) result.gap = std::max(result.gap, 0.0);

  const auto [p, q] = closest_points(first, second);
  const Vec3 way = q - p;
  const double length = std::sqrt(squared_norm(way));
  result.point1 = p;
  result.point2 = q;
  if (meet) {
    // Divides the way as the radii do, so it is inside both.
    if (radii > 0.0) result.point1 = p + way * (sum.first / radii);
    result.point2 = result.point1;
  } else if (radii > 0.0 && length > 0.0) {
    result.point1 = p + way * (sum.first / length);
    result.point2 = q - way * (sum.second / length);
  }
  return result;
}

}  // namespace hinge::robotics
