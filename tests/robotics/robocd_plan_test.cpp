// SPDX-License-Identifier: BSD-3-Clause
// Tests robocd plan: what it writes is free by robocd path, failures are said and keep what was found, bad input is
// refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "robotics/run_robocd.hpp"

namespace hinge::robotics {
namespace robocd_plan_test {

using Json = nlohmann::json;
using test::ArmFolder;
using test::run_robocd;

const std::string data = std::string(HINGE_SOURCE_DIR) + "/robotics/data/";
const std::string scene = " " + data + "arm.urdf --srdf " + data + "arm.srdf --env shelf=" + data + "shelf.obj ";
const std::string reach = "plan" + scene + "--from state:arm/home --to state:arm/reach ";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<std::vector<double>> read_rows(const std::string& file) {
  std::ifstream in(file);
  std::vector<std::vector<double>> rows;
  std::string line, field;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    rows.emplace_back();
    while (std::getline(fields, field, ',')) rows.back().push_back(std::stod(field));
  }
  return rows;
}

TEST(RobocdPlan, WritesAMotionThatPathProvesFree) {
  const test::TemporaryFolder folder;
  const std::string out = (folder.path() / "motion.csv").string();
  EXPECT_EQ(run_robocd("path" + scene + "--from state:arm/home --to state:arm/reach").status, 1);
  for (int seed = 1; seed <= 3; ++seed) {
    const auto said = run_robocd(reach + "--json --seed " + std::to_string(seed) + " --out " + out);
    ASSERT_EQ(said.status, 0) << said.out;
    const Json json = Json::parse(said.out);
    EXPECT_EQ(json.at("reached"), true);
    EXPECT_EQ(json.at("remaining"), 0.0);
    EXPECT_GT(json.at("length").get<double>(), json.at("straight").get<double>());
    EXPECT_EQ(json.at("rows"), json.at("waypoints").size());
    EXPECT_EQ(Json(read_rows(out)), json.at("waypoints"));  // every digit is written
    EXPECT_EQ(json.at("waypoints").back(), json.at("to").at("values"));
    EXPECT_EQ(run_robocd("path" + scene + "--waypoints " + out).status, 0);
    EXPECT_EQ(run_robocd("check" + scene + "--csv-in " + out).status, 0);
  }
  EXPECT_EQ(run_robocd(reach).out, run_robocd(reach).out);
  EXPECT_TRUE(has(run_robocd(reach).out, "free: proved for every state between neighbouring waypoints"));
}

TEST(RobocdPlan, WritesStepsOfTheSizeAskedFor) {
  const test::TemporaryFolder folder;
  const std::string out = (folder.path() / "motion.csv").string();
  const Json json = Json::parse(run_robocd(reach + "--json --step 0.1 --out " + out).out);
  const auto rows = read_rows(out);
  EXPECT_EQ(rows.size(), json.at("rows"));
  EXPECT_GT(rows.size(), json.at("waypoints").size());
  for (std::size_t k = 1; k < rows.size(); ++k)
    for (std::size_t j = 0; j < rows[k].size(); ++j) EXPECT_LE(std::abs(rows[k][j] - rows[k - 1][j]), 0.1 + 1e-12);
  EXPECT_EQ(run_robocd("path" + scene + "--waypoints " + out).status, 0);
}

TEST(RobocdPlan, SaysWhatFails) {
  const test::TemporaryFolder folder;
  const std::string out = (folder.path() / "motion.csv").string();
  const auto few = run_robocd(reach + "--tries 5 --out " + out + " 2>&1");
  EXPECT_EQ(few.status, 5);
  EXPECT_TRUE(has(few.out, "no motion was found; ")) << few.out;
  EXPECT_TRUE(has(few.out, "note: more tested motions (--tries) or another --seed may help")) << few.out;
  EXPECT_EQ(run_robocd("check" + scene + "--csv-in " + out).status, 0);
  EXPECT_EQ(run_robocd(reach + "--tries 5 --exit-zero 2>&1").status, 0);
  const auto end = run_robocd("plan" + scene + "--from state:arm/home --to 0,0.9,0.9,0,0.4,0 2>&1");
  EXPECT_EQ(end.status, 1);
  EXPECT_TRUE(has(end.out, "the end collides\n")) << end.out;
  EXPECT_TRUE(has(end.out, "left_finger                  shelf\n")) << end.out;
  EXPECT_TRUE(has(end.out, "note: a motion needs ends without collisions; robocd relax")) << end.out;
  const auto start = run_robocd("plan" + scene + "--json --to state:arm/home --from 0,0.9,0.9,0,0.4,0 2>/dev/null");
  EXPECT_EQ(start.status, 1);
  EXPECT_EQ(Json::parse(start.out).at("colliding_end"), "start");
  EXPECT_EQ(Json::parse(start.out).at("environment_pairs").size(), 2U);
}

TEST(RobocdPlan, StopsAfterATime) {
  // Two walls between the ends: the shoulder cannot pass.
  const ArmFolder arm;
  const std::string stuck = "plan" + arm.urdf() +
                            " --env 'wall=box:0.05 9 9,xyz=0.3 0 0' --env 'other=box:0.05 9 9,xyz=-0.3 0 0' "
                            "--from zero --to 3.14159,0 ";
  const auto timed = run_robocd(stuck + "--tries 1000000000 --time 0.2 2>&1");
  EXPECT_EQ(timed.status, 5) << timed.out;
  EXPECT_TRUE(has(timed.out, "note: --time has passed")) << timed.out;
}

TEST(RobocdPlan, RefusesBadInput) {
  const auto refused = [&](const std::string& arguments) { return run_robocd(arguments + " 2>/dev/null").status; };
  EXPECT_EQ(refused("plan" + scene + "--to zero"), 2);                           // no start
  EXPECT_EQ(refused("plan" + scene + "--from zero --to 1,2"), 2);                // two values of six
  EXPECT_EQ(refused("plan" + scene + "--from zero --to @missing.csv"), 3);       // no file
  EXPECT_EQ(refused("plan" + scene + "--from zero --to state:arm/nowhere"), 2);  // no state
  EXPECT_EQ(refused(reach + "--step 0.1"), 2);                                   // no file to write
  EXPECT_EQ(refused(reach + "--step 0 --out out.csv"), 2);
  EXPECT_EQ(refused(reach + "--out " + data + "arm.urdf"), 2);  // an input
  EXPECT_EQ(refused(reach + "--tries 0"), 2);
}

}  // namespace robocd_plan_test
}  // namespace hinge::robotics
