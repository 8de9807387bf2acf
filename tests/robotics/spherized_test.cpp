// SPDX-License-Identifier: BSD-3-Clause
// Tests robots made of spheres: files are read exactly, and answers equal those of all pairs of balls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "hinge/hierarchy.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "robotics/robots.hpp"

namespace hinge::robotics {
namespace spherized_test {

struct Spherized {
  std::string folder, file;
  std::size_t spheres;  // number of <sphere> elements in the file
};

class SpherizedRobots : public testing::TestWithParam<Spherized> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(path())) GTEST_SKIP() << "no shared data at " << path();
  }
  static std::filesystem::path path() { return test::shared_folder(GetParam().folder) / GetParam().file; }
};

TEST_P(SpherizedRobots, AreReadAsExactSpheres) {
  const Robot robot(read_urdf(path()));
  ASSERT_EQ(robot.model().size(), GetParam().spheres);
  ASSERT_EQ(robot.radii().size(), GetParam().spheres);
  for (std::size_t k = 0; k < GetParam().spheres; ++k) {
    const Triangle& t = robot.model().primitives()[k];
    EXPECT_EQ(t.a, t.b);
    EXPECT_EQ(t.a, t.c);
    EXPECT_GT(robot.radii()[k], 0.0);
  }
  EXPECT_EQ(robot.degenerate_count(), 0U);
}

/// Returns the smallest |c - c'| - r - r' over all pairs of spheres of tested links.
double smallest_gap(std::span<const Triangle> placed, const Robot& robot, const LinkPairs& tested) {
  const auto links = robot.model().links();
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < placed.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (tested.contains(links[i], links[j]))
        gap = std::min(gap, (placed[i].a - placed[j].a).norm() - robot.radii()[i] - robot.radii()[j]);
  return gap;
}

TEST_P(SpherizedRobots, AreAsFarFromThemselvesAsTheirBallsAre) {
  const Robot robot(read_urdf(path()));
  const LinkPairs tested = tested_pairs(robot);
  Hierarchy hierarchy(robot.model(), LinkPairFilter(robot, tested), LinkMargins(robot));
  constexpr std::uint64_t seed = 5;
  SampleStream stream(seed, 0);
  int colliding = 0, free = 0;
  for (int k = 0; k < 200; ++k) {
    hierarchy.update(robot.expand(test::random_configuration(robot, stream)));
    const double gap = smallest_gap(hierarchy.placed(), robot, tested);
    const auto closest = hierarchy.self_closest();
    ASSERT_TRUE(closest.has_value());
    EXPECT_NEAR(closest->gap(), gap, 1e-14) << "seed " << seed << ", configuration " << k;
    EXPECT_EQ(hierarchy.self_collides(), gap < 0.0) << "seed " << seed << ", configuration " << k;
    ++(gap < 0.0 ? colliding : free);
  }
  std::printf("%s: %d collide, %d are free\n", GetParam().file.c_str(), colliding, free);
  EXPECT_GT(colliding, 0);
}

INSTANTIATE_TEST_SUITE_P(All, SpherizedRobots,
                         testing::Values(Spherized{"panda", "panda_spherized.urdf", 59},
                                         Spherized{"ur5_robotiq", "ur5_spherized.urdf", 40},
                                         Spherized{"baxter", "baxter_spherized.urdf", 75}),
                         [](const auto& robot) { return robot.param.folder; });

/// The same without shared data: an arm of balls and capsules.
TEST(RoundedRobot, IsAsFarFromItselfAsPointsAndSegmentsGrown) {
  RobotDescription description;
  description.name = "arm";
  for (int k = 0; k < 5; ++k) {
    LinkDescription& link = description.links.emplace_back();
    link.name = "l" + std::to_string(k);
    link.geometry.emplace_back().shape = SphereShape{0.05 + 0.01 * k};
    PlacedShape& rod = link.geometry.emplace_back();
    rod.shape = CapsuleShape{0.03, 0.25};
    rod.origin.translation = Vec3(0, 0, 0.15);
    if (k == 0) continue;
    JointDescription& joint = description.joints.emplace_back();
    joint.name = "j" + std::to_string(k);
    joint.type = JointType::continuous;
    joint.parent = "l" + std::to_string(k - 1);
    joint.child = link.name;
    joint.origin.translation = Vec3(0, 0, 0.3);
    joint.axis = k % 2 == 0 ? Vec3(1, 0, 0.3) : Vec3(0, 1, 0.1);
  }
  const Robot robot(description);
  ASSERT_EQ(robot.model().size(), 10U);
  const LinkPairs tested = tested_pairs(robot);
  Hierarchy hierarchy(robot.model(), LinkPairFilter(robot, tested), LinkMargins(robot));
  SampleStream stream(6, 0);
  // The distance of segments is found by sampling: never too small, and too large by at most the sampling error.
  constexpr int parts = 200;
  const auto at = [](const Triangle& t, int k) { return Vec3(t.a + (t.b - t.a) * (1.0 * k / parts)); };
  for (int k = 0; k < 20; ++k) {
    hierarchy.update(robot.expand(test::random_configuration(robot, stream)));
    const auto placed = hierarchy.placed();
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < placed.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        if (!tested.contains(robot.model().links()[i], robot.model().links()[j])) continue;
        const double radii = robot.radii()[i] + robot.radii()[j];
        for (int m = 0; m <= parts; ++m)
          for (int n = 0; n <= parts; ++n) gap = std::min(gap, (at(placed[i], m) - at(placed[j], n)).norm() - radii);
      }
    const auto closest = hierarchy.self_closest();
    ASSERT_TRUE(closest.has_value());
    EXPECT_LE(closest->gap(), gap + 1e-14);
    EXPECT_NEAR(closest->gap(), gap, 0.25 / parts);
  }
}

}  // namespace spherized_test
}  // namespace hinge::robotics
