// SPDX-License-Identifier: BSD-3-Clause
// Tests the collision matrix: kinds of pairs, proofs near contact, clearances, mimic joints, rejected input.
#include "hinge/robotics/collision_matrix.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "robotics/built_robots.hpp"

namespace hinge::robotics {
namespace collision_matrix_test {

using test::Builder;
using test::few_samples;

constexpr double pi = 3.141592653589793;

MatrixEntry entry_of(const Robot& robot, const std::string& a, const std::string& b, const MatrixOptions& options) {
  const LinkId first = robot.find_link(a).value(), second = robot.find_link(b).value();
  for (const MatrixEntry& entry : find_collision_matrix(robot, options).entries)
    if (entry.link1 == std::min(first, second) && entry.link2 == std::max(first, second)) return entry;
  ADD_FAILURE() << "no entry for " << a << " and " << b;
  return {};
}

PairKind kind(const Robot& robot, const MatrixOptions& options = few_samples()) {
  return entry_of(robot, "a", "c", options).kind;
}

/// Link a has a wall with its near face at x = wall. Link c is a rod on an arm with two joints; the largest x of its
/// corners is 0.5 + sqrt(0.4^2 + 0.05^2) = 0.903113 m.
Robot arm_before_wall(double wall, JointType type = JointType::revolute) {
  return Builder()
      .link("a")
      .box({0.2, 4, 1}, {wall + 0.1, 0, 0})
      .link("b")
      .link("c")
      .box({0.4, 0.1, 0.1}, {0.2, 0, 0})
      .joint(type, "a", "b", Vec3::Zero(), Vec3::UnitZ(), -2.5, 2.5)
      .joint(type, "b", "c", {0.5, 0, 0}, Vec3::UnitZ(), -2.5, 2.5)
      .robot();
}

TEST(CollisionMatrix, ProvesThatAnArmStaysShortOfAWall) {
  for (const JointType type : {JointType::revolute, JointType::continuous}) {
    const MatrixEntry near = entry_of(arm_before_wall(0.9032, type), "a", "c", few_samples());
    EXPECT_EQ(near.kind, PairKind::never);
    ASSERT_TRUE(near.smallest_gap.has_value());
    EXPECT_GE(*near.smallest_gap, 0.9032 - 0.903113);  // the true smallest gap
    EXPECT_EQ(kind(arm_before_wall(1.5, type)), PairKind::never);
  }
}

TEST(CollisionMatrix, ProvesNothingWhereAnArmReachesAWall) {
  EXPECT_EQ(kind(arm_before_wall(0.7)), PairKind::in_default);
  EXPECT_EQ(kind(arm_before_wall(0.9)), PairKind::in_default);
}

TEST(CollisionMatrix, FindsASliverThatSamplesMiss) {
  MatrixOptions options = few_samples();
  options.samples = 20;
  for (const double wall : {0.9030, 0.903112}) {
    const MatrixEntry sliver = entry_of(arm_before_wall(wall), "a", "c", options);
    EXPECT_EQ(sliver.kind, PairKind::sometimes);
    EXPECT_EQ(sliver.hits, 0U);
    EXPECT_EQ(sliver.smallest_gap, 0.0);
  }
  options.cells = 0;
  EXPECT_EQ(kind(arm_before_wall(0.9030), options), PairKind::unseen);
}

TEST(CollisionMatrix, LimitsDecide) {
  const auto drawer = [](double travel) {
    return Builder()
        .link("a")
        .box({0.1, 1, 1}, {1.0, 0, 0})
        .link("b")
        .link("c")
        .box({0.2, 0.2, 0.2}, Vec3::Zero())
        .joint(JointType::prismatic, "a", "b", Vec3::Zero(), Vec3::UnitX(), -0.3, travel)
        .joint(JointType::revolute, "b", "c", Vec3::Zero(), Vec3::UnitX(), -0.1, 0.1)
        .robot();
  };
  // The face of the drawer starts 0.85 m from the wall.
  EXPECT_EQ(kind(drawer(0.8499)), PairKind::never);
  EXPECT_EQ(kind(drawer(0.8501)), PairKind::sometimes);
}

/// A rod that rotates down to a floor and touches it at 1 rad. Link b only slides along the axis, from 0 to `slide`.
Builder rod_above_floor(double slide, double lowest, const Shape& rod = BoxShape{{0.4, 0.1, 0.1}}) {
  const double floor = 0.5 - 0.4 * std::sin(1.0) - 0.05 * std::cos(1.0);
  Builder build;
  build.link("a")
      .box({4, 0.2, 4}, {0, floor - 0.1, 0})
      .link("b")
      .link("c")
      .shape(rod, {0.2, 0, 0})
      .joint(JointType::prismatic, "a", "b", Vec3::Zero(), Vec3::UnitZ(), 0, slide)
      .joint(JointType::revolute, "b", "c", {0, 0.5, 0}, Vec3::UnitZ(), lowest, 0);
  return build;
}

TEST(CollisionMatrix, LimitsOfTurningDecide) {
  for (const double more : {1e-7, 1e-4, 1e-2}) {
    EXPECT_EQ(kind(rod_above_floor(0.1, -1.0 + more).robot()), PairKind::never) << more;
    EXPECT_NE(kind(rod_above_floor(0.1, -1.0 - more).robot()), PairKind::never) << more;
  }
}

/// Two needles on one line; their bounding balls touch only at the needle tips. One needle slides towards the other.
TEST(CollisionMatrix, NeedlesMeetPointToPoint) {
  const auto needles = [](double travel) {
    TriangleMesh mesh;
    mesh.triangles.push_back({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0)});
    const MeshShape needle{std::make_shared<const TriangleMesh>(mesh)};
    return Builder()
        .link("a")
        .shape(needle, {2, 0, 0})
        .link("b")
        .link("c")
        .shape(needle, Vec3::Zero())
        .joint(JointType::prismatic, "a", "b", Vec3::Zero(), Vec3::UnitX(), 0, travel)
        .joint(JointType::revolute, "b", "c", Vec3::Zero(), Vec3::UnitX(), 0, 1)
        .robot();
  };
  for (const double more : {1e-9, 1e-6, 1e-4, 1e-3}) {
    EXPECT_EQ(kind(needles(1.0 - more)), PairKind::never) << more;
    EXPECT_NE(kind(needles(1.0 + more)), PairKind::never) << more;
  }
}

/// Each piece of the triangle that contains the tip has its centre nearer to the axis, so the centre moves slower than
/// the tip.
TEST(CollisionMatrix, TipsThatOutrunTheirMiddlesCount) {
  TriangleMesh mesh;
  mesh.triangles.push_back({Vec3(0.2, -0.05, 0), Vec3(0.1, 0.02, 0.01), Vec3(0.1, -0.02, 0)});
  const MeshShape tip{std::make_shared<const TriangleMesh>(mesh)};
  for (const double more : {1e-8, 1e-7, 1e-6, 1e-5, 1e-4}) {
    EXPECT_EQ(kind(rod_above_floor(0.1, -1.0 + more, tip).robot()), PairKind::never) << more;
    EXPECT_NE(kind(rod_above_floor(0.1, -1.0 - more, tip).robot()), PairKind::never) << more;
  }
}

/// A tiny triangle moves on a circle and is nearest to the wall at both joint limits.
TEST(CollisionMatrix, ArcsAreNotTakenForTheirTangents) {
  const auto speck = [](double wall) {
    TriangleMesh mesh;
    mesh.triangles.push_back({Vec3(1, 0, 0), Vec3(1, 0, 1e-6), Vec3(1, 0, 0)});
    return Builder()
        .link("a")
        .box({0.2, 4, 1}, {wall - 0.1, 0, 0})
        .link("b")
        .link("c")
        .shape(MeshShape{std::make_shared<const TriangleMesh>(mesh)}, Vec3::Zero())
        .joint(JointType::revolute, "a", "b", Vec3::Zero(), Vec3::UnitZ(), -0.5, 0.5)
        .joint(JointType::prismatic, "b", "c", Vec3::Zero(), Vec3::UnitZ(), 0, 0.1)
        .robot();
  };
  for (const double more : {1e-7, 1e-5, 1e-3}) {
    EXPECT_EQ(kind(speck(std::cos(0.5) - more)), PairKind::never) << more;
    EXPECT_NE(kind(speck(std::cos(0.5) + more)), PairKind::never) << more;
  }
}

TEST(CollisionMatrix, FollowersTurnByTheirMultiplierAndOffset) {
  for (const double more : {1e-7, 1e-4, 1e-2}) {
    EXPECT_EQ(kind(rod_above_floor(0.5 - more, 0).mimic("to_b", -2.0, 0.0).robot()), PairKind::never) << more;
    EXPECT_NE(kind(rod_above_floor(0.5 + more, 0).mimic("to_b", -2.0, 0.0).robot()), PairKind::never) << more;
    EXPECT_EQ(kind(rod_above_floor(0.5 - more, 0).mimic("to_b", 1.0, -0.5).robot()), PairKind::never) << more;
    EXPECT_NE(kind(rod_above_floor(0.5, 0).mimic("to_b", 1.0, -1.0 - more).robot()), PairKind::never) << more;
  }
}

TEST(CollisionMatrix, ClearanceCountsAsMeeting) {
  MatrixOptions options = few_samples();
  const auto with = [&](double clearance) {
    options.clearance = clearance;
    return kind(arm_before_wall(0.95), options);
  };
  EXPECT_EQ(with(0.0468), PairKind::never);  // 0.95 - 0.903113 = 0.046887
  EXPECT_EQ(with(0.0470), PairKind::sometimes);
  for (const double bad : {-1e-9, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(with(bad), ModelError);
}

/// Two fingers that slide or rotate on a palm b. With `follows`, the second is a mimic joint of the first.
Robot gripper(bool follows, JointType type) {
  const double open = type == JointType::prismatic ? 0.1 : 1.0;
  Builder build;
  build.link("b")
      .link("a")
      .box({0.2, 0.02, 0.02}, {0.1, 0, 0})
      .link("c")
      .box({0.2, 0.02, 0.02}, {0.1, 0, 0})
      .joint(type, "b", "a", Vec3::Zero(), type == JointType::prismatic ? Vec3::UnitY() : Vec3::UnitZ(), 0, open)
      .joint(type, "b", "c", {0, 0.05, 0}, type == JointType::prismatic ? Vec3::UnitY() : Vec3::UnitZ(), 0, open);
  if (follows) build.mimic("to_a", 1.0, 0.0);
  return build.robot();
}

TEST(CollisionMatrix, FollowersAreFunctionsOfTheirDriver) {
  for (const JointType type : {JointType::prismatic, JointType::revolute}) {
    EXPECT_EQ(kind(gripper(true, type)), PairKind::never);
    EXPECT_EQ(kind(gripper(false, type)), PairKind::sometimes);
  }
}

TEST(CollisionMatrix, SpheresMeetWhereTheirRadiiSay) {
  const auto balls = [](double travel) {
    return Builder()
        .link("a")
        .shape(SphereShape{0.1}, {2, 0, 0})
        .link("b")
        .link("c")
        .shape(SphereShape{0.2}, Vec3::Zero())
        .joint(JointType::prismatic, "a", "b", Vec3::Zero(), Vec3::UnitX(), 0, travel)
        .joint(JointType::revolute, "b", "c", Vec3::Zero(), Vec3::UnitY(), -1, 1)
        .robot();
  };
  for (const double more : {1e-9, 1e-6, 1e-4, 1e-3}) {
    EXPECT_EQ(kind(balls(1.7 - more)), PairKind::never) << more;
    EXPECT_NE(kind(balls(1.7 + more)), PairKind::never) << more;
  }
}

TEST(CollisionMatrix, TellsNeighboursAndConstantMeetingsApart) {
  const Robot robot = Builder()
                          .link("a")
                          .box({1, 1, 1}, Vec3::Zero())
                          .link("b")
                          .box({1, 1, 1}, Vec3::Zero())
                          .link("c")
                          .box({1.2, 1, 0.1}, Vec3::Zero())
                          .link("d")
                          .box({1, 1, 1}, Vec3::Zero())
                          .joint(JointType::revolute, "a", "b", Vec3::Zero(), Vec3::UnitZ(), -1, 1)
                          .joint(JointType::revolute, "b", "c", Vec3::Zero(), Vec3::UnitZ(), -1, 1)
                          .joint(JointType::fixed, "c", "d", Vec3::Zero(), Vec3::UnitZ(), 0, 0)
                          .robot();
  EXPECT_EQ(entry_of(robot, "a", "b", few_samples()).kind, PairKind::adjacent);
  EXPECT_EQ(entry_of(robot, "b", "d", few_samples()).kind, PairKind::adjacent);
  EXPECT_EQ(entry_of(robot, "c", "d", few_samples()).kind, PairKind::adjacent);
  const MatrixEntry constant = entry_of(robot, "a", "c", few_samples());
  EXPECT_EQ(constant.kind, PairKind::always);
  EXPECT_EQ(constant.hits, 200U);
  EXPECT_EQ(constant.samples, 200U);
}

TEST(CollisionMatrix, DefaultIsTheMiddleWhereZeroIsOutside) {
  const auto turned = [](double lower, double upper) {
    return Builder()
        .link("a")
        .box({0.1, 0.1, 0.1}, {0, 1, 0})
        .link("b")
        .link("c")
        .box({0.1, 0.1, 0.1}, {1, 0, 0})
        .joint(JointType::revolute, "a", "b", Vec3::Zero(), Vec3::UnitZ(), lower, upper)
        .joint(JointType::revolute, "b", "c", Vec3::Zero(), Vec3::UnitZ(), -0.01, 0.01)
        .robot();
  };
  EXPECT_EQ(kind(turned(1.0, pi - 1.0)), PairKind::in_default);
  EXPECT_EQ(kind(turned(-1.0, pi - 1.0)), PairKind::sometimes);
}

TEST(CollisionMatrix, LeavesOpenWhatRoundingCouldDecide) {
  // World coordinates near 1e7 m are multiples of 2e-9 m (double precision).
  const auto at = [](double gap) {
    return Builder()
        .link("root")
        .link("a")
        .box({0.2, 4, 1}, {0.1, 0, 0})
        .link("b")
        .link("c")
        .box({0.1, 0.1, 0.1}, {-0.05 - gap, 0, 0})
        .joint(JointType::fixed, "root", "a", {1e7, 0, 0}, Vec3::UnitZ(), 0, 0)
        .joint(JointType::prismatic, "a", "b", Vec3::Zero(), Vec3::UnitY(), 0, 1)
        .joint(JointType::prismatic, "b", "c", Vec3::Zero(), Vec3::UnitY(), 0, 1)
        .robot();
  };
  EXPECT_EQ(kind(at(1e-8)), PairKind::unseen);
  EXPECT_EQ(kind(at(1e-4)), PairKind::never);
}

TEST(CollisionMatrix, IsTheSameEveryTimeAndReportsProgress) {
  const Robot robot = arm_before_wall(0.9032);
  double last = 0.0;
  bool proving = false;
  const auto progress = [&](const MatrixProgress& at) {
    if (!proving && at.stage == MatrixProgress::Stage::proving) last = 0.0;
    proving = at.stage == MatrixProgress::Stage::proving;
    EXPECT_GE(at.fraction, last);
    last = at.fraction;
  };
  const CollisionMatrix once = find_collision_matrix(robot, few_samples(), progress);
  EXPECT_EQ(last, 1.0);
  const CollisionMatrix twice = find_collision_matrix(robot, few_samples());
  ASSERT_EQ(once.entries.size(), twice.entries.size());
  for (std::size_t k = 0; k < once.entries.size(); ++k) {
    EXPECT_EQ(once.entries[k].kind, twice.entries[k].kind);
    EXPECT_EQ(once.entries[k].hits, twice.entries[k].hits);
    EXPECT_EQ(once.entries[k].cells, twice.entries[k].cells);
    EXPECT_EQ(once.entries[k].smallest_gap, twice.entries[k].smallest_gap);
  }
}

TEST(CollisionMatrix, KeepsToItsBudget) {
  MatrixOptions options = few_samples();
  options.cells = 7;
  const MatrixEntry entry = entry_of(arm_before_wall(0.9032), "a", "c", options);
  EXPECT_EQ(entry.kind, PairKind::unseen);
  EXPECT_LE(entry.cells, 7U);
  EXPECT_GT(entry.cells, 0U);
}

}  // namespace collision_matrix_test
}  // namespace hinge::robotics
