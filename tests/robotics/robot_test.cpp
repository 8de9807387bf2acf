// SPDX-License-Identifier: BSD-3-Clause
// Tests Robot: its model, order of joints, mimic joints, limits, rejected descriptions.
#include "hinge/robotics/robot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/robotics/tested_pairs.hpp"

namespace hinge::robotics {
namespace robot_test {

const double nan = std::numeric_limits<double>::quiet_NaN();

JointDescription joint(const std::string& name, JointType type, const std::string& parent, const std::string& child,
                       const Vec3& at = Vec3::Zero()) {
  JointDescription joint;
  joint.name = name;
  joint.type = type;
  joint.parent = parent;
  joint.child = child;
  joint.origin.translation = at;
  joint.axis = Vec3::UnitZ();
  joint.lower = -3.0;
  joint.upper = 3.0;
  return joint;
}

/// Three rods of length 1 and width 0.1 in a row, rotating about z. A plate is fixed to the last. The order is shuffled
/// on purpose.
RobotDescription arm() {
  const PlacedShape rod{BoxShape{{1.0, 0.1, 0.1}}, Pose{Mat3::Identity(), Vec3(0.5, 0, 0)}};
  RobotDescription robot;
  robot.name = "arm";
  robot.links = {{"plate", {{BoxShape{{0.1, 0.1, 0.1}}}}}, {"base", {rod}}, {"middle", {rod}}, {"end", {rod}}};
  robot.joints = {joint("wrist", JointType::revolute, "middle", "end", Vec3(1, 0, 0)),
                  joint("mount", JointType::fixed, "end", "plate", Vec3(1, 0, 0)),
                  joint("elbow", JointType::continuous, "base", "middle", Vec3(1, 0, 0))};
  return robot;
}

std::string refusal(const RobotDescription& description) {
  try {
    const Robot robot(description);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

TEST(Robot, IsBuiltInCodeWithLinksParentsFirst) {
  const Robot robot(arm());
  ASSERT_EQ(robot.link_count(), 5U);
  EXPECT_EQ(robot.link_name(world), "");
  EXPECT_EQ(robot.link_name(id<LinkId>(1)), "base");
  EXPECT_EQ(robot.link_name(id<LinkId>(2)), "middle");
  EXPECT_EQ(robot.link_name(id<LinkId>(4)), "plate");
  EXPECT_EQ(robot.find_link("end"), id<LinkId>(3));
  EXPECT_FALSE(robot.find_link("").has_value());
  EXPECT_EQ(robot.model().size(), 48U);
  EXPECT_EQ(robot.triangle_count(id<LinkId>(2)), 12U);
  EXPECT_EQ(robot.model().links()[13], id<LinkId>(2));
  EXPECT_EQ(robot.degenerate_count(), 0U);
}

TEST(Robot, KeepsIndependentJointsInTheOrderGiven) {
  const Robot robot(arm());
  ASSERT_EQ(robot.independent_joints().size(), 2U);
  EXPECT_EQ(robot.independent_name(0), "wrist");
  EXPECT_EQ(robot.independent_name(1), "elbow");
  EXPECT_EQ(robot.lower()[0], -3.0);
  EXPECT_DOUBLE_EQ(robot.upper()[1], std::acos(-1.0));
  // The model orders parents first, so the elbow is first.
  EXPECT_EQ(robot.joint_of(DofId{0}), 2U);
  EXPECT_EQ(robot.expand(std::vector<double>{0.25, 0.5}), (std::vector<double>{0.5, 0.25}));
}

TEST(Robot, CollidesWhenFoldedBackAndNotWhenStraight) {
  const Robot robot(arm());
  Hierarchy hierarchy(robot.model(), LinkPairFilter(robot, tested_pairs(robot)), UniformClearance(0.0));
  hierarchy.update(robot.expand(std::vector<double>{0.0, 0.0}));
  EXPECT_FALSE(hierarchy.self_collides());
  // The three rods form a triangle: the end returns to the base.
  const double third = 2 * std::acos(-1.0) / 3;
  hierarchy.update(robot.expand(std::vector<double>{third, third}));
  EXPECT_TRUE(hierarchy.self_collides());
}

TEST(Robot, DrivesFollowersThroughChains) {
  RobotDescription description = arm();
  description.joints[2].mimic = Mimic{"wrist", -2.0, 0.5};
  description.links.push_back({"tip", {}});
  description.joints.push_back(joint("tip joint", JointType::prismatic, "plate", "tip"));
  description.joints.back().mimic = Mimic{"elbow", 3.0, 1.0};
  description.joints.back().lower = 5.0;  // limits of a follower are ignored
  const Robot robot(description);
  ASSERT_EQ(robot.independent_joints().size(), 1U);
  // By DOF: elbow = -2 q + 0.5, wrist = q, tip = 3 elbow + 1.
  EXPECT_EQ(robot.expand(std::vector<double>{0.25}), (std::vector<double>{0.0, 0.25, 1.0}));
}

TEST(Robot, RefusesConfigurationsNamingTheJoint) {
  const Robot robot(arm());
  const auto message = [&](const std::vector<double>& q) -> std::string {
    try {
      robot.expand(q);
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message({1.0}), "configuration has 1 values, expected 2, one for each independent joint");
  EXPECT_EQ(message({1.0, nan}), "joint 'elbow' is nan, expected a finite number");
  std::vector<double> small(1);
  EXPECT_THROW(robot.expand(std::vector<double>{0.0, 0.0}, small), ConfigurationError);
}

TEST(Robot, RefusesTreesThatAreNone) {
  EXPECT_EQ(refusal({}), "the robot has no links");
  RobotDescription robot = arm();
  robot.links[0].name = "base";
  EXPECT_EQ(refusal(robot), "link 'base': the name is already used");
  robot = arm();
  robot.joints[1].name = "wrist";
  EXPECT_EQ(refusal(robot), "joint 'wrist': the name is already used");
  robot = arm();
  robot.joints[0].parent = "nowhere";
  EXPECT_EQ(refusal(robot), "joint 'wrist': its parent link 'nowhere' does not exist");
  robot = arm();
  robot.joints.pop_back();
  EXPECT_EQ(refusal(robot), "links 'base' and 'middle' both have no parent; expected one root");
  robot = arm();
  robot.joints[2].parent = "plate";
  EXPECT_NE(refusal(robot).find("joints form a cycle"), std::string::npos);
  robot = arm();
  robot.joints.push_back(joint("again", JointType::fixed, "base", "end"));
  EXPECT_EQ(refusal(robot), "joint 'again': its child link 'end' is already the child of joint 'wrist'");
  robot = arm();
  robot.joints.push_back(joint("round", JointType::fixed, "plate", "base"));
  EXPECT_NE(refusal(robot).find("joints form a cycle"), std::string::npos);
}

TEST(Robot, RefusesJointsAndShapesThatAreNone) {
  RobotDescription robot = arm();
  robot.joints[0].axis = Vec3::Zero();
  EXPECT_NE(refusal(robot).find("joint 'wrist': its axis is 0 0 0"), std::string::npos);
  robot = arm();
  robot.joints[0].upper = nan;
  EXPECT_EQ(refusal(robot), "joint 'wrist': its limits are -3 and nan, expected finite numbers");
  robot = arm();
  robot.joints[0].origin.rotation *= 1.001;
  EXPECT_NE(refusal(robot).find("not a rigid placement"), std::string::npos);
  robot = arm();
  robot.links[1].geometry[0].shape = MeshShape{};
  EXPECT_EQ(refusal(robot), "link 'base': mesh: has no triangles");
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->triangles.resize(2);
  mesh->triangles[1].c[2] = nan;
  robot.links[1].geometry[0].shape = MeshShape{mesh};
  EXPECT_EQ(refusal(robot),
            "link 'base': mesh: triangle 1 has a vertex that is not finite, expected finite coordinates");
}

TEST(Robot, RefusesMimicsThatLeadNowhere) {
  RobotDescription robot = arm();
  robot.joints[0].mimic = Mimic{"nothing"};
  EXPECT_EQ(refusal(robot), "joint 'wrist': mimics joint 'nothing', which does not exist");
  robot.joints[0].mimic = Mimic{"mount"};
  EXPECT_EQ(refusal(robot), "joint 'wrist': mimics joint 'mount', which is fixed");
  robot.joints[0].mimic = Mimic{"elbow", nan};
  EXPECT_NE(refusal(robot).find("expected finite numbers"), std::string::npos);
  robot.joints[0].mimic = Mimic{"elbow"};
  robot.joints[2].mimic = Mimic{"wrist"};
  EXPECT_NE(refusal(robot).find("which depends on this joint in turn"), std::string::npos);
}

TEST(Robot, CountsTrianglesWithoutAreaAndKeepsThem) {
  RobotDescription robot = arm();
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->triangles = {{Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2)}, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}};
  robot.links[1].geometry = {{MeshShape{mesh}}};
  const Robot built(robot);
  EXPECT_EQ(built.degenerate_count(), 1U);
  EXPECT_EQ(built.triangle_count(id<LinkId>(1)), 2U);
}

TEST(Robot, GivesSpheresAndCapsulesTheirRadius) {
  RobotDescription robot = arm();
  EXPECT_TRUE(Robot(robot).radii().empty());
  const Pose aside{rotation_about(Vec3::UnitX(), std::acos(0.0)), Vec3(0, 0, 2)};
  robot.links[1].geometry = {{SphereShape{0.25}, aside}, {BoxShape{}}, {CapsuleShape{0.5, 4.0}, aside}};
  const Robot built(robot);
  ASSERT_EQ(built.triangle_count(id<LinkId>(1)), 14U);
  ASSERT_EQ(built.radii().size(), built.model().size());
  EXPECT_EQ(built.radii()[0], 0.25);
  EXPECT_EQ(built.model().primitives()[0].a, Vec3(0, 0, 2));
  for (std::size_t k = 1; k < 13; ++k) EXPECT_EQ(built.radii()[k], 0.0);
  EXPECT_EQ(built.radii()[13], 0.5);
  EXPECT_LE((built.model().primitives()[13].a - Vec3(0, 2, 2)).norm(), 1e-15);
  EXPECT_LE((built.model().primitives()[13].b - Vec3(0, -2, 2)).norm(), 1e-15);
  EXPECT_EQ(built.radii()[14], 0.0);
  // Points and segments with a radius do not count as degenerate.
  EXPECT_EQ(built.degenerate_count(), 0U);
  EXPECT_TRUE(Robot(robot, {Tessellation::Manner::inscribed}).radii().empty());
}

}  // namespace robot_test
}  // namespace hinge::robotics
