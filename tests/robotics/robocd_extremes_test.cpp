// SPDX-License-Identifier: BSD-3-Clause
// Tests robocd dial --extremes: exact verdicts do not depend on a scale by a power of two, tiers miss nothing, and
// single precision is counted right.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/random_configuration.hpp"
#include "hinge/robotics/read_urdf.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "robotics/run_robocd.hpp"

namespace hinge::robotics {
namespace robocd_extremes_test {

using Json = nlohmann::json;
using test::ArmFolder;
using test::run_robocd;

Json extremes_of(const std::string& robot) {
  return Json::parse(run_robocd("dial" + robot + " -n 10 --time 1 --seed 3 --extremes --json").out).at("extremes");
}

Json row_of(const Json& extremes, const std::string& name) {
  for (const Json& row : extremes.at("rows"))
    if (row[0] == name) return row;
  ADD_FAILURE() << "no row " << name;
  return Json::array({"", "", "", "", "", "", "", ""});
}

bool has(const Json& cell, const std::string& part) { return cell.get<std::string>().find(part) != std::string::npos; }

TEST(RobocdExtremes, ExactVerdictsDoNotDependOnTheScale) {
  const ArmFolder folder;
  for (const std::string& robot : {" " + std::string(HINGE_SOURCE_DIR) + "/robotics/data/arm.urdf", folder.urdf()}) {
    const Json extremes = extremes_of(robot);
    const Json near = row_of(extremes, "nearly touching");
    EXPECT_EQ(near[1], "400") << near;
    EXPECT_EQ(near[2], "200") << near;  // of two neighbours one collides
    EXPECT_EQ(near[3], "same");
    for (const char* scale : {"2^-20", "2^-10", "2^10", "2^20"}) {
      const Json row = row_of(extremes, std::string("nearly touching, scaled by ") + scale);
      EXPECT_EQ(row[2], "200") << row;
      EXPECT_EQ(row[3], "same") << row;
    }
    for (const Json& row : extremes.at("rows"))
      for (std::size_t tier = 4; tier < 7; ++tier)
        EXPECT_TRUE(row[tier] == "right" || row[tier] == "cannot be fitted" || has(row[tier], "0 missed,")) << row;
    EXPECT_TRUE(has(near[7], "missed")) << near;  // floats cannot tell neighbours apart
  }
}

TEST(RobocdExtremes, ASeedGivesTheSameTable) {
  const ArmFolder folder;
  EXPECT_EQ(extremes_of(folder.urdf()), extremes_of(folder.urdf()));
}

/// Two balls on slides: the second one follows the first at a distance that a slide sets. Their surfaces touch at
/// slide = 0.
constexpr const char* balls = R"(<robot name="balls"><link name="base"/>
  <link name="a"><collision><geometry><sphere radius="0.3"/></geometry></collision></link>
  <link name="m"/>
  <link name="b"><collision><geometry><sphere radius="0.2"/></geometry></collision></link>
  <joint name="up" type="prismatic"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/></joint>
  <joint name="side" type="prismatic"><parent link="base"/><child link="m"/><axis xyz="0 1 0"/>
    <limit lower="-0.5" upper="0.5" effort="1" velocity="1"/></joint>
  <joint name="out" type="prismatic"><parent link="m"/><child link="b"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>)";

TEST(RobocdExtremes, SinglePrecisionIsCountedRight) {
  const test::TemporaryFolder folder;
  folder.write("balls.urdf", balls);
  const std::string file = (folder.path() / "balls.urdf").string();
  const Json row = row_of(extremes_of(" " + file), "nearly touching");
  // The same search: free and colliding configurations in the order of the seed, bisected.
  const auto robot = std::make_shared<const Robot>(read_urdf(file));
  RobotChecker checker(robot, tested_pairs(*robot), LinkMargins(*robot));
  const auto collides = [&](const std::vector<double>& q) {
    checker.update(q);
    return checker.collides();
  };
  std::vector<std::vector<double>> free, colliding;
  for (std::uint64_t k = 0; std::min(free.size(), colliding.size()) < 200; ++k) {
    std::vector<double> q(3);
    random_configuration(*robot, 3, k, q);
    (collides(q) ? colliding : free).push_back(q);
  }
  std::size_t missed = 0, added = 0;
  for (std::size_t n = 0; n < 200; ++n) {
    const auto at = [&](double t) {
      std::vector<double> q(3);
      for (std::size_t j = 0; j < 3; ++j) q[j] = free[n][j] + t * (colliding[n][j] - free[n][j]);
      return q;
    };
    double low = 0.0, high = 1.0;
    for (double middle = 0.5; middle > low && middle < high; middle = low + (high - low) / 2.0)
      (collides(at(middle)) ? high : low) = middle;
    for (const double t : {low, high}) {
      const std::vector<double> q = at(t);
      // up, side, out: centres (0, 0, up) and (out, side, 0), rounded to floats.
      const float x = 0.0F - static_cast<float>(q[2]), y = 0.0F - static_cast<float>(q[1]),
                  z = static_cast<float>(q[0]) - 0.0F;
      const auto m = static_cast<float>(0.3 + 0.2);
      const float squared = x * x + y * y + z * z;
      const bool given = squared < m * m || squared == 0.0F;
      missed += t == high && !given ? 1U : 0U;
      added += t == low && given ? 1U : 0U;
    }
  }
  EXPECT_EQ(row[7], std::to_string(missed) + " missed, " + std::to_string(added) + " false") << row;
  EXPECT_GT(missed, 0U);
  EXPECT_GT(added, 0U);
}

TEST(RobocdExtremes, RobotsThatNeverCollideAreSaidToBeSo) {
  const test::TemporaryFolder folder;
  std::string apart = balls;
  apart.replace(apart.find("xyz=\"0 0 1\""), 11, "xyz=\"0 0 1\"")
      .replace(apart.find("radius=\"0.3\""), 12, "radius=\"0.0\"");
  apart.replace(apart.find("lower=\"0\""), 9, "lower=\"0.9\"");
  folder.write("apart.urdf", apart);
  const Json extremes = extremes_of(" " + (folder.path() / "apart.urdf").string());
  EXPECT_EQ(extremes.at("rows").size(), 1U);
  EXPECT_TRUE(has(extremes.at("notes")[0], "no random configuration collides"));
}

}  // namespace robocd_extremes_test
}  // namespace hinge::robotics
