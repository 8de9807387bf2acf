// SPDX-License-Identifier: BSD-3-Clause
// Tests shapes with a size of 0: every engine treats points, segments and flat solids exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "hinge/robotics/collision_matrix.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "hinge/robotics/tiers.hpp"

namespace hinge::robotics {
namespace flat_shapes_test {

/// A robot whose link with the shape slides along x towards a ball of radius 0.5 at the origin.
std::shared_ptr<const Robot> slider(const Shape& shape) {
  RobotDescription robot{"slider", {{"ball", {{SphereShape{0.5}}}}, {"between"}, {"shape", {{shape}}}}, {}};
  JointDescription still;
  still.name = "still";
  still.parent = "ball";
  still.child = "between";
  still.type = JointType::prismatic;
  robot.joints.push_back(still);
  JointDescription slide = still;
  slide.name = "slide";
  slide.parent = "between";
  slide.child = "shape";
  slide.lower = -4;
  slide.upper = 4;
  robot.joints.push_back(slide);
  return std::make_shared<const Robot>(robot);
}

struct Case {
  Shape shape;
  double reach;  ///< distance from the joint's position back to the nearest point of the shape
};

/// The disc is a prism of height 0 around the circle, at most 1 mm outside it.
const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {SphereShape{0}, 0},      {BoxShape{{0, 0, 0}}, 0},      {BoxShape{{0, 1, 0}}, 0}, {BoxShape{{0.5, 0, 0}}, 0.25},
      {BoxShape{{0, 1, 1}}, 0}, {BoxShape{{0.5, 1, 0}}, 0.25}, {CylinderShape{0, 1}, 0}, {CylinderShape{0, 0}, 0},
      {CapsuleShape{0, 1}, 0},  {CapsuleShape{0.25, 0}, 0.25}};
  return all;
}

RobotChecker checker_of(const std::shared_ptr<const Robot>& robot, const std::string& engine) {
  return {robot, tested_pairs(*robot, LinkPairs(robot->link_count())), LinkMargins(*robot, 0.0), CheckOptions{engine}};
}

TEST(FlatShapes, AreJudgedRightByEveryEngine) {
  for (const std::string engine : {"simd", "lazy", "brute"})
    for (const Case& c : cases()) {
      RobotChecker checker = checker_of(slider(c.shape), engine);
      for (const double x : {0.0, 0.125, 0.5, 1.0, 2.0, -2.0}) {
        checker.update(std::vector<double>{0, x});
        const double expected = std::max(0.0, std::abs(x) - 0.5 - c.reach);
        EXPECT_EQ(checker.collides(), expected == 0.0) << engine << " case " << &c - cases().data() << " at " << x;
        const auto closest = checker.closest();
        ASSERT_TRUE(closest);
        EXPECT_NEAR(closest->distance, expected, 1e-15) << engine << " case " << &c - cases().data() << " at " << x;
      }
    }
}

TEST(FlatShapes, CollideWithBodiesAndOnPaths) {
  TriangleMesh wall;
  wall.triangles.push_back({{-3, -4, -4}, {-3, 4, -4}, {-3, 0, 4}});
  const auto mesh = std::make_shared<const TriangleMesh>(wall);
  for (const Case& c : cases()) {
    RobotChecker checker = checker_of(slider(c.shape), "simd");
    Environment environment(0.0, "simd");
    environment.add(mesh, {}, "wall");
    checker.update(std::vector<double>{0, -2.5});
    EXPECT_EQ(checker.collides(environment), false);
    EXPECT_NEAR(checker.closest(environment)->distance, 0.5 - c.reach, 1e-15);
    checker.update(std::vector<double>{0, -3});
    EXPECT_TRUE(checker.collides(environment));

    PathChecker paths(checker);
    using Values = std::vector<double>;
    EXPECT_TRUE(paths.certify(Values{0, 1}, Values{0, 4}).is_free());
    EXPECT_EQ(paths.certify(Values{0, 1}, Values{0, -4}).verdict, PathVerdict::colliding);
  }
}

TEST(FlatShapes, MayBeBodiesThemselves) {
  for (const std::string engine : {"simd", "lazy", "brute"})
    for (const Case& c : cases()) {
      RobotChecker checker = checker_of(slider(SphereShape{0.25}), engine);
      Environment environment(0.0, engine);
      const BodyId body = environment.add(c.shape, {Mat3::Identity(), Vec3(3, 0, 0)}, "flat");
      for (const double x : {0.0, 1.0, 2.0, 2.75, 3.0}) {
        checker.update(std::vector<double>{0, x});
        const double expected = std::clamp(std::abs(x - 3) - 0.25 - c.reach, 0.0,
                                           2.5 - c.reach);  // the ball at the origin limits the distance
        EXPECT_EQ(checker.collides(environment), expected == 0.0) << engine << " case " << &c - cases().data();
        const auto closest = checker.closest(environment);
        ASSERT_TRUE(closest);
        EXPECT_NEAR(closest->distance, expected, 1e-15);
        EXPECT_EQ(checker.distances(environment, 0.5).size(), expected < 0.5 ? 1U : 0U);
      }
      environment.remove(body);
    }
}

/// Every tier encloses these shapes. The matrix finds the pairs that collide and proves that others never do.
TEST(FlatShapes, AreTakenByTiersAndTheMatrix) {
  for (const Case& c : cases()) {
    const std::string which = "case " + std::to_string(&c - cases().data());
    const auto robot = slider(c.shape);
    for (const Tier tier : {Tier::mesh, Tier::hull, Tier::capsule, Tier::spheres}) {
      const auto tiered = std::make_shared<const Robot>(with_tiers(robot->description(), Tiers{tier}));
      RobotChecker checker = checker_of(tiered, "simd");
      checker.update(std::vector<double>{0, 0.5 + c.reach});
      EXPECT_TRUE(checker.collides()) << which << " " << name(tier);
      checker.update(std::vector<double>{0, 3.0});
      EXPECT_FALSE(checker.collides()) << which << " " << name(tier);
    }
    RobotDescription description = robot->description();
    MatrixOptions options;
    options.samples = 100;
    const auto kind = [&](double lower, double upper) {
      description.joints.at(1).lower = lower;
      description.joints.at(1).upper = upper;
      return find_collision_matrix(Robot(description), options).entries.at(0).kind;
    };
    EXPECT_EQ(kind(-4, 4), PairKind::in_default) << which;
    EXPECT_EQ(kind(0.25 + c.reach, 4), PairKind::sometimes) << which;
    EXPECT_EQ(kind(1, 4), PairKind::never) << which;
  }
}

}  // namespace flat_shapes_test
}  // namespace hinge::robotics
