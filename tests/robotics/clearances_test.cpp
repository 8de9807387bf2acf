// SPDX-License-Identifier: BSD-3-Clause
// RobotChecker::clearances: numbers of distances(), normals, depths of spheres and capsules; jacobian: finite
// differences, mimic joints, bodies, held bodies, a moved base.
#include "hinge/robotics/clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "robotics/random_robot.hpp"

namespace hinge::robotics {
namespace clearances_test {

constexpr std::uint64_t seed = 811;
constexpr double infinity = std::numeric_limits<double>::infinity();

RobotChecker checker_of(const std::shared_ptr<const Robot>& robot, double clearance = 0.0,
                        const std::string& engine = "simd") {
  return {robot, tested_pairs(*robot), LinkMargins(*robot, clearance), {engine}};
}

/// Names a row of links or bodies.
auto key(const LinkClearance& row) { return std::tuple(row.link1, row.link2); }
auto key(const BodyClearance& row) { return std::tuple(row.link, row.held, row.body); }

/// Compares the rows of the Jacobian with central differences of the distances. Skips rows whose witness points jump:
/// the one-sided slopes differ there. Returns the number of rows compared.
template <class Ask>
std::size_t compare_with_differences(RobotChecker& checker, const std::vector<double>& q, const Ask& ask) {
  constexpr double step = 1e-6;
  checker.update(q);
  const auto rows = ask();
  const ClearanceJacobian jacobian = checker.jacobian(std::span(rows));
  EXPECT_EQ(jacobian.rows(), static_cast<Eigen::Index>(rows.size()));
  EXPECT_EQ(jacobian.cols(), static_cast<Eigen::Index>(q.size()));
  std::size_t compared = 0;
  for (std::size_t j = 0; j < q.size(); ++j) {
    std::map<decltype(key(rows.front())), std::pair<double, double>> moved;
    for (const double sign : {-1.0, 1.0}) {
      std::vector<double> there = q;
      there[j] += sign * step;
      checker.update(there);
      for (const auto& row : ask()) (sign < 0.0 ? moved[key(row)].first : moved[key(row)].second) = row.distance;
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (squared_norm(rows[k].normal) == 0.0) continue;
      const auto [below, above] = moved[key(rows[k])];
      const double left = (rows[k].distance - below) / step, right = (above - rows[k].distance) / step;
      if (std::abs(left - right) > 1e-3) continue;
      ++compared;
      EXPECT_NEAR(jacobian(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)), (left + right) / 2, 2e-4);
    }
  }
  checker.update(q);
  return compared;
}

TEST(Clearances, AreTheDistancesWithNormals) {
  std::size_t apart = 0, deep = 0, without = 0;
  for (std::uint64_t number = 0; number < 10; ++number) {
    SampleStream stream(seed, number);
    const auto robot = std::make_shared<const Robot>(test::random_description(stream, 7));
    RobotChecker checker = checker_of(robot, 0.01), brute = checker_of(robot, 0.01, "brute");
    for (int k = 0; k < 8; ++k) {
      std::vector<double> q;
      for (std::size_t j = 0; j < robot->independent_joints().size(); ++j) q.push_back(stream.uniform() * 2.0 - 1.0);
      checker.update(q);
      brute.update(q);
      const std::vector<ClosestLinks> distances = checker.distances(0.5);
      const std::vector<LinkClearance> rows = checker.clearances(0.5), slow = brute.clearances(0.5);
      ASSERT_EQ(rows.size(), distances.size());
      ASSERT_EQ(rows.size(), slow.size());
      for (std::size_t p = 0; p < rows.size(); ++p) {
        const LinkClearance& row = rows[p];
        EXPECT_EQ(row.link1, distances[p].link1);
        EXPECT_EQ(row.link2, distances[p].link2);
        EXPECT_EQ(row.distance, slow[p].distance);  // same bits for every engine
        EXPECT_TRUE(row.normal == slow[p].normal);
        EXPECT_EQ(row.gap, distances[p].gap);
        EXPECT_EQ(std::max(row.distance, 0.0), distances[p].distance);
        EXPECT_TRUE(row.is_signed || row.distance >= 0.0);
        const double length = norm(row.normal);
        if (length == 0.0) {
          ++without;
          EXPECT_EQ(row.distance, 0.0);
          continue;
        }
        EXPECT_NEAR(length, 1.0, 1e-14);
        // The points lie on the two surfaces, at the distance along the normal.
        EXPECT_NEAR(norm(Vec3(row.point1 + row.normal * row.distance - row.point2)), 0.0, 1e-12);
        (row.distance < 0.0 ? deep : apart) += 1;
      }
    }
  }
  EXPECT_GT(apart, 200U);
  EXPECT_GT(deep, 10U);
  EXPECT_GT(without, 5U);
}

TEST(Clearances, HaveTheDerivativesOfTheDistances) {
  std::size_t links = 0, bodies = 0;
  for (std::uint64_t number = 0; number < 10; ++number) {
    SampleStream stream(seed, number);
    const auto robot = std::make_shared<const Robot>(test::random_description(stream, 7));
    RobotChecker checker = checker_of(robot);
    if (number % 2 == 1) checker.set_base(test::random_pose(stream, 1.0));
    Environment environment(0.0, "simd");
    environment.add(BoxShape{{0.5, 0.25, 0.75}}, {Mat3::Identity(), Vec3(2.5, 0.25, -0.125)}, "box");
    environment.add(SphereShape{0.4}, {Mat3::Identity(), Vec3(0.2, 0.3, 0.4)}, "ball");
    const BodyId tool = environment.add(SphereShape{0.1}, {}, "tool");
    environment.attach(tool, robot, id<LinkId>(robot->link_count() - 1), {Mat3::Identity(), Vec3(0.0, 0.2, 0.0)});
    for (int k = 0; k < 4; ++k) {
      std::vector<double> q;
      for (std::size_t j = 0; j < robot->independent_joints().size(); ++j) q.push_back(stream.uniform() * 2.0 - 1.0);
      links += compare_with_differences(checker, q, [&] { return checker.clearances(3.0); });
      bodies += compare_with_differences(checker, q, [&] { return checker.clearances(environment, 3.0); });
    }
  }
  EXPECT_GT(links, 500U);
  EXPECT_GT(bodies, 500U);
}

TEST(Clearances, OfTwoBallsGoOnBelowZero) {
  RobotDescription description{"balls", {{"a", {{SphereShape{0.5}}}}, {"between"}, {"b", {{SphereShape{0.25}}}}}, {}};
  description.joints.push_back({"slide", JointType::prismatic, "a", "between"});
  description.joints.back().axis = Vec3::UnitX();
  description.joints.back().lower = -10.0;
  description.joints.back().upper = 10.0;
  description.joints.push_back({"spin", JointType::continuous, "between", "b"});
  description.joints.back().axis = Vec3::UnitX();
  const auto robot = std::make_shared<const Robot>(description);
  RobotChecker checker = checker_of(robot);
  for (const double x : {2.0, 0.76, 0.7, 0.5, 0.1, 1e-9}) {
    checker.update(std::vector<double>{x, 0.3});
    const std::vector<LinkClearance> rows = checker.clearances(5.0);
    ASSERT_EQ(rows.size(), 1U) << x;
    EXPECT_NEAR(rows[0].distance, x - 0.75, 1e-12);
    EXPECT_TRUE(rows[0].is_signed);
    EXPECT_NEAR(norm(Vec3(rows[0].normal - Vec3::UnitX())), 0.0, 1e-12);
    const ClearanceJacobian jacobian = checker.jacobian(std::span(rows));
    EXPECT_NEAR(jacobian(0, 0), 1.0, 1e-12);
    EXPECT_NEAR(jacobian(0, 1), 0.0, 1e-12);
  }
  checker.update(std::vector<double>{0.0, 0.3});  // one centre on the other: no direction
  const std::vector<LinkClearance> rows = checker.clearances(5.0);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].distance, 0.0);
  EXPECT_FALSE(rows[0].is_signed);
  EXPECT_EQ(checker.jacobian(std::span(rows))(0, 0), 0.0);
}

TEST(Clearances, RefuseBadArguments) {
  SampleStream stream(seed, 1);
  const auto robot = std::make_shared<const Robot>(test::random_description(stream, 4));
  RobotChecker checker = checker_of(robot);
  for (const double influence : {-1.0, infinity, std::nan("")})
    EXPECT_THROW(checker.clearances(influence), ConfigurationError);
  std::vector<LinkClearance> rows(1);
  rows[0].link2 = id<LinkId>(robot->link_count());
  EXPECT_THROW(checker.jacobian(std::span<const LinkClearance>(rows)), ModelError);
}

}  // namespace clearances_test
}  // namespace hinge::robotics
