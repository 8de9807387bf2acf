// SPDX-License-Identifier: BSD-3-Clause
// Tests the capsule tier: it contains all points and is not much larger than necessary.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <variant>
#include <vector>

#include "hinge/kinematics/joint.hpp"
#include "robotics/tiered.hpp"

namespace hinge::robotics {
namespace fit_capsule_test {

struct Fitted {
  Vec3 a, b;
  double radius = 0.0;

  double volume() const { return std::numbers::pi * radius * radius * ((b - a).norm() + radius * 4 / 3); }
};

Fitted fitted(std::span<const Vec3> points) {
  const auto geometry = test::tiered(test::lone_link(test::as_triangles(points)), Tier::capsule);
  EXPECT_EQ(geometry.size(), 1U);
  const PlacedShape& placed = geometry.at(0);
  EXPECT_TRUE(is_rigid(placed.origin));
  if (const auto* sphere = std::get_if<SphereShape>(&placed.shape))
    return {placed.origin.translation, placed.origin.translation, sphere->radius};
  const auto& capsule = std::get<CapsuleShape>(placed.shape);
  const Vec3 end(0, 0, capsule.length / 2);
  return {placed.origin * Vec3(-end), placed.origin * end, capsule.radius};
}

/// Returns how far the farthest point is outside the capsule; below 0 if all are inside.
long double excess(const Fitted& capsule, std::span<const Vec3> points) {
  using Long = Eigen::Matrix<long double, 3, 1>;
  const Long a = capsule.a.cast<long double>(), along = capsule.b.cast<long double>() - a;
  long double most = -1.0L;
  for (const Vec3& p : points) {
    const Long from = p.cast<long double>() - a;
    const long double square = along.squaredNorm();
    const long double share = square > 0.0L ? std::clamp(from.dot(along) / square, 0.0L, 1.0L) : 0.0L;
    most = std::max(most, (from - share * along).norm() - capsule.radius);
  }
  return most;
}

TEST(FitCapsule, HasEveryPointInside) {
  SampleStream stream(7, 0);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<Vec3> points = test::random_points(seed, 4 * seed);
    const Vec3 size = test::random_point(stream), away = test::random_point(stream);
    for (Vec3& p : points) p = p.cwiseProduct(size) + 10 * away;
    EXPECT_LE(excess(fitted(points), points), -0.9e-10L) << "seed " << seed;
  }
}

TEST(FitCapsule, HoldsDegeneratePoints) {
  for (const auto& [name, points] : test::degenerate_points())
    EXPECT_LE(excess(fitted(points), points), -0.9e-10L) << name;
}

TEST(FitCapsule, FindsTheCapsuleThatPointsWereTakenFrom) {
  SampleStream stream(8, 0);
  const Mat3 turn = rotation_about(Vec3(1, 2, 2) / 3.0, 0.7);
  std::vector<Vec3> points;
  for (int k = 0; k < 4000; ++k) {
    const Vec3 on_sphere = 0.2 * test::random_point(stream).normalized();
    points.emplace_back(turn * (on_sphere + Vec3(0, 0, k % 2 == 0 ? 0.8 : -0.8)) + Vec3(1, 2, 3));
  }
  const Fitted capsule = fitted(points);
  EXPECT_NEAR(capsule.radius, 0.2, 0.002);
  EXPECT_NEAR((capsule.b - capsule.a).norm(), 1.6, 0.02);
  EXPECT_NEAR(std::abs((capsule.b - capsule.a).normalized().dot(turn.col(2))), 1.0, 1e-4);
}

TEST(FitCapsule, IsAsSmallAsTheBestOfManyDirections) {
  for (const Vec3& size : {Vec3(1, 0.1, 0.1), Vec3(1, 0.6, 0.2), Vec3(1, 1, 1), Vec3(0.3, 1, 0.9)}) {
    std::vector<Vec3> box;
    for (unsigned k = 0; k < 8; ++k)
      box.emplace_back((k & 1U) != 0 ? size[0] : 0, (k & 2U) != 0 ? size[1] : 0, (k & 4U) != 0 ? size[2] : 0);
    const double found = fitted(box).volume();
    // The best capsule around the box's centre in 2000 directions.
    double best = std::numbers::pi * 4 / 3 * std::pow((size / 2).norm(), 3);
    for (const Vec3& direction : test::random_points(55, 2000)) {
      const Vec3 unit = direction.normalized(), centre = size / 2;
      double radius = 0.0, half = 0.0;
      for (const Vec3& p : box) radius = std::max(radius, cross(Vec3(p - centre), unit).norm());
      for (const Vec3& p : box) {
        const double across = cross(Vec3(p - centre), unit).norm();
        half = std::max(half, (p - centre).dot(unit) - std::sqrt(std::max(0.0, radius * radius - across * across)));
      }
      best = std::min(best, std::numbers::pi * radius * radius * (2 * half + radius * 4 / 3));
    }
    EXPECT_LE(found, best * 1.001) << size.transpose();
  }
}

TEST(FitCapsule, GivesASphereWhereASegmentWouldNotHelp) {
  SampleStream stream(9, 0);
  std::vector<Vec3> points;
  for (int k = 0; k < 2000; ++k) points.emplace_back(0.3 * test::random_point(stream).normalized());
  const Fitted sphere = fitted(points);
  EXPECT_LE(sphere.volume(), std::numbers::pi * 4 / 3 * 0.027 * 1.1);
  const Fitted point = fitted(std::vector<Vec3>(3, Vec3(1, 2, 3)));
  EXPECT_EQ(point.a, point.b);
  EXPECT_LE(point.radius, 2e-10);
}

}  // namespace fit_capsule_test
}  // namespace hinge::robotics
