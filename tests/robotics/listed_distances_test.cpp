// SPDX-License-Identifier: BSD-3-Clause
// Tests distances of all link pairs within a margin: equal for every engine, down to the triangles unless they meet,
// and fast if millions of triangle pairs are within the margin.
#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/tessellate.hpp"
#include "robotics/random_robot.hpp"

namespace hinge::robotics {
namespace listed_distances_test {

constexpr std::uint64_t seed = 305;

RobotChecker checker_of(const std::shared_ptr<const Robot>& robot, const std::string& engine, double clearance) {
  return {robot, tested_pairs(*robot), LinkMargins(*robot, clearance), {engine}};
}

TEST(ListedDistances, AreTheSameFromEveryEngine) {
  std::size_t listed = 0, apart = 0, with_body = 0;
  for (std::uint64_t number = 0; number < 12; ++number) {
    SampleStream stream(seed, number);
    const auto robot = std::make_shared<const Robot>(test::random_description(stream, 7));
    for (const double clearance : {0.0, 0.05}) {
      RobotChecker wanted = checker_of(robot, "brute", clearance), quick = checker_of(robot, "simd", clearance);
      Environment slow(0.0, "brute"), fast(0.0, "simd");
      for (Environment* environment : {&slow, &fast})
        environment->add(BoxShape{{0.5, 0.25, 0.75}}, {Mat3::Identity(), Vec3(0.5, 0.25, -0.125)}, "box");
      for (int k = 0; k < 6; ++k) {
        std::vector<double> q;
        for (std::size_t j = 0; j < robot->independent_joints().size(); ++j) q.push_back(stream.uniform() * 2.0 - 1.0);
        wanted.update(q);
        quick.update(q);
        for (const double margin : {0.0, 0.01, 0.3, 5.0}) {
          const auto expected = wanted.distances(margin), found = quick.distances(margin);
          ASSERT_EQ(found.size(), expected.size());
          ASSERT_EQ(found.size(), quick.within(margin).size());
          for (std::size_t p = 0; p < found.size(); ++p) {
            EXPECT_EQ(found[p].link1, expected[p].link1);
            EXPECT_EQ(found[p].link2, expected[p].link2);
            EXPECT_EQ(found[p].distance, expected[p].distance);
            EXPECT_EQ(found[p].gap, expected[p].gap);
            if (found[p].distance == 0.0) continue;  // any pair of triangles that meet
            EXPECT_EQ(found[p].triangle1, expected[p].triangle1);
            EXPECT_EQ(found[p].triangle2, expected[p].triangle2);
            EXPECT_TRUE(found[p].point1 == expected[p].point1);
            ++apart;
          }
          listed += found.size();
          const auto bodies = wanted.distances(slow, margin), near = quick.distances(fast, margin);
          ASSERT_EQ(near.size(), bodies.size());
          for (std::size_t p = 0; p < near.size(); ++p) {
            EXPECT_EQ(near[p].link, bodies[p].link);
            EXPECT_EQ(near[p].distance, bodies[p].distance);
            EXPECT_EQ(near[p].gap, bodies[p].gap);
            if (near[p].distance == 0.0) continue;
            EXPECT_EQ(near[p].triangle1, bodies[p].triangle1);
          }
          with_body += near.size();
        }
      }
    }
  }
  EXPECT_GT(listed, 1000U);
  EXPECT_GT(apart, 300U);
  EXPECT_GT(with_body, 200U);
}

/// Boxes have no radii: nothing is closer than a contact. With margin 0 nothing else is listed.
TEST(ListedDistances, OfContactsWithoutRadii) {
  const PlacedShape box{BoxShape{{1, 1, 1}}};
  RobotDescription boxes{"boxes", {{"a", {box}}, {"b", {box}}, {"c", {box}}}, {}};
  boxes.joints.push_back({"slide", JointType::prismatic, "a", "b", {Mat3::Identity(), Vec3(0.5, 0.25, 0.125)}});
  boxes.joints.push_back({"away", JointType::prismatic, "b", "c", {Mat3::Identity(), Vec3(0.25, 0.5, 0.25)}});
  const auto robot = std::make_shared<const Robot>(boxes);
  for (const std::string engine : {"brute", "lazy", "simd"}) {
    SCOPED_TRACE(engine);
    RobotChecker checker = checker_of(robot, engine, 0.0);
    Environment environment(0.0, engine);
    environment.add(BoxShape{{0.5, 0.5, 0.5}}, {Mat3::Identity(), Vec3(0.5, 0.5, 0.5)}, "box");
    checker.update(std::vector<double>{0.0, 0.0});
    for (const double margin : {0.0, 0.01}) {
      const auto links = checker.distances(margin);
      ASSERT_EQ(links.size(), 1U);  // a and c
      EXPECT_EQ(links[0].distance, 0.0);
      EXPECT_EQ(checker.distances(environment, margin).size(), 3U);
      for (const ClosestBody& pair : checker.distances(environment, margin)) EXPECT_EQ(pair.distance, 0.0);
    }
  }
}

/// Two meshes of 10 580 triangles each. All triangle pairs, 112 million, are within the margin.
TEST(ListedDistances, OfFineMeshesAreQuick) {
  const Tessellation fine{Tessellation::Manner::circumscribed, 3e-4};
  const auto ball = std::make_shared<const TriangleMesh>(TriangleMesh{tessellate(SphereShape{0.5}, fine).triangles});
  ASSERT_GT(ball->triangles.size(), 10000U);
  RobotDescription pair{"pair", {{"a", {{MeshShape{ball}}}}, {"between"}, {"b", {{MeshShape{ball}}}}}, {}};
  pair.joints.push_back({"turn", JointType::continuous, "a", "between"});
  pair.joints.push_back({"slide", JointType::prismatic, "between", "b", {Mat3::Identity(), Vec3(1.25, 0.125, 0)}});
  RobotChecker checker = checker_of(std::make_shared<const Robot>(pair), "simd", 0.0);
  Environment environment;
  environment.add(ball, {Mat3::Identity(), Vec3(0, 1.25, 0.125)}, "ball");
  const auto start = std::chrono::steady_clock::now();
  const auto links = checker.distances(5.0);
  const auto bodies = checker.distances(environment, 5.0);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  ASSERT_EQ(links.size(), 1U);
  EXPECT_EQ(links[0].distance, checker.closest()->distance);
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].distance, checker.closest(environment)->distance);
  EXPECT_LT(took.count(), 2.0);
}

}  // namespace listed_distances_test
}  // namespace hinge::robotics
