// SPDX-License-Identifier: BSD-3-Clause
// Welzl, "Smallest enclosing disks", 1991, as three nested loops; Badoiu and Clarkson, "Smaller core-sets for balls",
// 2003.
#include "approximation/enclosing_ball.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "approximation/convex_hull.hpp"

namespace hinge::robotics {

namespace {

using Point = std::array<double, 2>;

double squared_distance(const Point& p, const Point& q) {
  return (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
}

/// Relative tolerance. Without it, rounding puts the points that define the circle outside again and again.
constexpr double circle_tolerance = 1e-12;

bool holds(const Circle& c, const Point& p) {
  return squared_distance({c.x, c.y}, p) <= c.radius * c.radius * (1 + circle_tolerance);
}

Circle around(const Point& p, const Point& q) {
  return {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, std::sqrt(squared_distance(p, q)) / 2};
}

/// Returns the circle through three points. For collinear points: the circle around the two that are farthest apart.
Circle through(const Point& p, const Point& q, const Point& r) {
  const double ux = q[0] - p[0], uy = q[1] - p[1], vx = r[0] - p[0], vy = r[1] - p[1];
  const double twice_area = ux * vy - uy * vx, uu = ux * ux + uy * uy, vv = vx * vx + vy * vy;
  const double x = (vy * uu - uy * vv) / (2 * twice_area), y = (ux * vv - vx * uu) / (2 * twice_area);
  const double radius = std::sqrt(x * x + y * y);
  // Nearly collinear points make the division meaningless.
  if (std::abs(twice_area) > circle_tolerance * (uu + vv)) return {p[0] + x, p[1] + y, radius};
  return std::max({around(p, q), around(p, r), around(q, r)},
                  [](const Circle& a, const Circle& b) { return a.radius < b.radius; });
}

}  // namespace

Circle smallest_circle(std::span<const Point> points) {
  Circle circle{points[0][0], points[0][1], 0.0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (holds(circle, points[i])) continue;
    circle = {points[i][0], points[i][1], 0.0};
    for (std::size_t j = 0; j < i; ++j) {
      if (holds(circle, points[j])) continue;
      circle = around(points[i], points[j]);
      for (std::size_t k = 0; k < j; ++k)
        if (!holds(circle, points[k])) circle = through(points[i], points[j], points[k]);
    }
  }
  return circle;
}

Ball enclosing_ball(std::span<const Vec3> points) {
  constexpr int steps = 30;  // the excess of the radius decreases as 1 / steps
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : points) centre += p / static_cast<double>(points.size());
  Ball best;
  for (int k = 0; k <= steps; ++k) {
    double squared = -1.0;
    Vec3 farthest = centre;
    for (const Vec3& p : points) {
      const double square = squared_norm(Vec3(p - centre));
      if (square > squared) {
        squared = square;
        farthest = p;
      }
    }
    const double radius = std::sqrt(squared);
    if (k == 0 || radius < best.radius) best = {centre, radius};
    centre += (farthest - centre) / (k + 2.0);
  }
  return best;
}

double enclosing_radius(double farthest_squared) {
  // The square has a relative error of a few half ulps.
  return std::sqrt(farthest_squared) * (1 + 0x1p-48) + enclosing_margin;
}

}  // namespace hinge::robotics
