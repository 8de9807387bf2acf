// SPDX-License-Identifier: BSD-3-Clause
// Tests the sphere tier: it contains points on all triangles, and more spheres fit closer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "hinge/robotics/tessellate.hpp"
#include "robotics/tiered.hpp"

namespace hinge::robotics {
namespace fit_spheres_test {

/// Returns how far the farthest point of a grid on each triangle is outside the union of the spheres; below 0 if all
/// are inside.
double excess(std::span<const PlacedShape> spheres, std::span<const Triangle> triangles) {
  constexpr int parts = 24;
  double most = -1.0;
  for (const Triangle& t : triangles)
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j) {
        const Vec3 p = t.a + (t.b - t.a) * (1.0 * i / parts) + (t.c - t.a) * (1.0 * j / parts);
        double nearest = 1e300;
        for (const PlacedShape& s : spheres)
          nearest = std::min(nearest, (p - s.origin.translation).norm() - std::get<SphereShape>(s.shape).radius);
        most = std::max(most, nearest);
      }
  return most;
}

double largest_radius(std::span<const PlacedShape> spheres) {
  double most = 0.0;
  for (const PlacedShape& s : spheres) most = std::max(most, std::get<SphereShape>(s.shape).radius);
  return most;
}

TEST(FitSpheres, HoldEveryPointOfEveryTriangle) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const std::vector<Vec3> points = test::random_points(seed, 30);
    std::vector<Triangle> triangles;
    for (std::size_t k = 0; k + 2 < points.size(); k += 3)
      triangles.push_back({points[k], points[k + 1], points[k + 2]});
    for (const std::size_t most : {1U, 2U, 7U, 40U}) {
      const auto spheres = test::tiered(test::lone_link(triangles), Tier::spheres, most);
      EXPECT_LE(spheres.size(), most);
      EXPECT_LE(excess(spheres, triangles), 0.0) << "seed " << seed << ", " << most << " spheres";
    }
  }
}

TEST(FitSpheres, HoldDegenerateTriangles) {
  for (const auto& [name, points] : test::degenerate_points()) {
    std::vector<Triangle> triangles = test::as_triangles(points);
    for (std::size_t k = 0; k + 1 < points.size(); ++k) triangles.push_back({points[k], points[k + 1], points[k + 1]});
    const auto spheres = test::tiered(test::lone_link(triangles), Tier::spheres, 5);
    EXPECT_LE(spheres.size(), 5U);
    EXPECT_LE(excess(spheres, triangles), 0.0) << name;
  }
  const auto point = test::tiered(test::lone_link({Triangle{}}), Tier::spheres);
  ASSERT_EQ(point.size(), 1U);
  EXPECT_LE(largest_radius(point), 2e-10);
}

/// Returns how far the spheres extend beyond the faces of the unit cube.
double standing_out(std::span<const PlacedShape> spheres) {
  double most = -1.0;
  for (const PlacedShape& s : spheres) {
    const Vec3& c = s.origin.translation;
    most = std::max(
        most, std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2])}) + std::get<SphereShape>(s.shape).radius - 0.5);
  }
  return most;
}

TEST(FitSpheres, StandOutLessTheMoreThereAre) {
  const std::vector<Triangle> cube = tessellate(BoxShape{}).triangles;
  double before = 1.0;
  for (const std::size_t most : {1U, 8U, 24U, 54U}) {
    const double out = standing_out(test::tiered(test::lone_link(cube), Tier::spheres, most));
    EXPECT_LT(out, before) << most;
    before = out;
  }
  // One sphere is the circumscribed sphere. Nine spheres per face, centred on it, would extend by sqrt(2) / 6 = 0.236.
  EXPECT_NEAR(standing_out(test::tiered(test::lone_link(cube), Tier::spheres, 1)), std::sqrt(3.0) / 2 - 0.5, 0.02);
  EXPECT_LT(before, 0.15);
}

TEST(FitSpheres, FollowASlenderLink) {
  const std::vector<Triangle> rod = tessellate(BoxShape{{1.0, 0.02, 0.02}}).triangles;
  const auto spheres = test::tiered(test::lone_link(rod), Tier::spheres, 20);
  EXPECT_LT(largest_radius(spheres), 0.04);  // half of the diagonal of a twentieth of the rod is 0.029
}

}  // namespace fit_spheres_test
}  // namespace hinge::robotics
