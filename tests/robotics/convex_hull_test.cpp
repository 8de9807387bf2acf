// SPDX-License-Identifier: BSD-3-Clause
// Tests the hull tier against half-spaces in extended precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "robotics/tiered.hpp"

namespace hinge::robotics {
namespace convex_hull_test {

/// Returns the smallest depth of the points behind the planes of the triangles, m; negative if a point is in front.
long double least_depth(std::span<const Triangle> hull, std::span<const Vec3> points) {
  long double least = std::numeric_limits<long double>::infinity();
  for (const Triangle& t : hull) {
    long double u[3], v[3];
    for (int k = 0; k < 3; ++k) {
      u[k] = static_cast<long double>(t.b[k]) - t.a[k];
      v[k] = static_cast<long double>(t.c[k]) - t.a[k];
    }
    const long double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const long double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (const Vec3& p : points) {
      long double height = 0.0L;
      for (int k = 0; k < 3; ++k) height += n[k] * (static_cast<long double>(p[k]) - t.a[k]);
      least = std::min(least, -height / length);
    }
  }
  return least;
}

double reach(std::span<const Vec3> points, const Vec3& direction) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) most = std::max(most, direction.dot(p));
  return most;
}

std::vector<Vec3> corners(std::span<const Triangle> triangles) {
  std::vector<Vec3> corners;
  for (const Triangle& t : triangles) corners.insert(corners.end(), {t.a, t.b, t.c});
  return corners;
}

/// In 200 directions the hull extends as far as the points, and at most `excess` farther.
void expect_tight(std::span<const Triangle> hull, std::span<const Vec3> points, double excess) {
  const std::vector<Vec3> of_hull = corners(hull);
  for (const Vec3& direction : test::random_points(99, 200)) {
    const Vec3 unit = direction.normalized();
    EXPECT_GE(reach(of_hull, unit), reach(points, unit));
    EXPECT_LE(reach(of_hull, unit), reach(points, unit) + excess);
  }
}

TEST(ConvexHull, HasEveryPointBehindEveryTriangle) {
  for (const std::uint64_t seed : {11U, 12U, 13U, 14U}) {
    const std::vector<Vec3> points = test::random_points(seed, 30 * (seed - 10));
    const std::vector<Triangle> hull = test::hull_of(points);
    EXPECT_TRUE(test::is_closed(hull)) << "seed " << seed;
    EXPECT_GE(least_depth(hull, points), 0.9e-10L) << "seed " << seed;
    expect_tight(hull, points, 1e-8);
  }
}

TEST(ConvexHull, OfABoxOrAGridInItHasTwelveTriangles) {
  std::vector<Vec3> points;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      for (int k = 0; k < 5; ++k) points.emplace_back(0.25 * i, 0.5 * j, 0.1 * k);
  const std::vector<Triangle> hull = test::hull_of(points);
  EXPECT_EQ(hull.size(), 12U);
  EXPECT_TRUE(test::is_closed(hull));
  EXPECT_GE(least_depth(hull, points), 0.9e-10L);
  expect_tight(hull, points, 1e-8);
}

TEST(ConvexHull, GivesFlatStraightAndSinglePointsAThickness) {
  for (const auto& [name, points] : test::degenerate_points()) {
    const std::vector<Triangle> hull = test::hull_of(points);
    EXPECT_TRUE(test::is_closed(hull)) << name;
    EXPECT_GT(least_depth(hull, points), 0.0L) << name;
    expect_tight(hull, points, 1e-5);
  }
}

TEST(ConvexHull, HoldsThinPlatesAndSmallPartsFarAway) {
  std::vector<Vec3> plate = test::random_points(21, 200), far = test::random_points(22, 200);
  for (Vec3& p : plate) p[2] = p[2] > 0.0 ? 1e-3 : -1e-3;
  for (Vec3& p : far) p = 1e-3 * p + Vec3(500, -300, 20);
  for (const std::vector<Vec3>& points : {plate, far}) {
    const std::vector<Triangle> hull = test::hull_of(points);
    EXPECT_TRUE(test::is_closed(hull));
    EXPECT_GT(least_depth(hull, points), 0.0L);
    expect_tight(hull, points, 1e-5);
  }
}

TEST(ConvexHull, IsTheSameEveryTime) {
  const std::vector<Vec3> points = test::random_points(31, 100);
  std::vector<Vec3> turned = points;
  std::reverse(turned.begin(), turned.end());
  const auto first = corners(test::hull_of(points)), second = corners(test::hull_of(points));
  EXPECT_EQ(first, second);
  EXPECT_EQ(first, corners(test::hull_of(turned)));
}

TEST(ConvexHull, RefusesCoordinatesTooLargeForItsMargin) {
  std::vector<Vec3> points = test::random_points(41, 50);
  for (Vec3& p : points) p = 1e-3 * p + Vec3(1e12, 0, 0);
  try {
    test::hull_of(points);
    ADD_FAILURE() << "not refused";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("link 'link': no convex hull of "), std::string::npos) << error.what();
  }
}

}  // namespace convex_hull_test
}  // namespace hinge::robotics
