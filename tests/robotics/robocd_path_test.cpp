// SPDX-License-Identifier: BSD-3-Clause
// Tests robocd path and PathChecker against brute force: alone, among bodies, and with an attached body.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "robotics/random_robot.hpp"
#include "robotics/run_robocd.hpp"

namespace hinge::robotics {
namespace robocd_path_test {

using Json = nlohmann::json;
using test::ArmFolder;
using test::run_robocd;
using test::Said;

bool all_variants() { return std::getenv("HINGE_TEST_ALL") != nullptr; }

std::string path(const ArmFolder& arm, const std::string& arguments) {
  return "path" + arm.urdf() + " --srdf" + arm.file("arm.srdf") + " " + arguments;
}

std::string refused(const ArmFolder& arm, const std::string& arguments) {
  const Said said = run_robocd(path(arm, arguments) + " 2>&1 >/dev/null");
  return std::to_string(said.status) + ": " + said.out;
}

TEST(RobocdPath, ExitsWithTheVerdict) {
  const ArmFolder arm;
  EXPECT_EQ(run_robocd(path(arm, "--from zero --to 0,-1.3")).status, 0);
  EXPECT_EQ(run_robocd(path(arm, "--from zero --to 0,-1.4")).status, 1);
  EXPECT_EQ(run_robocd(path(arm, "--from zero --to state:all/turned,slide/in 2>&1")).status, 1);
  EXPECT_EQ(run_robocd(path(arm, "--from zero --to state:all/turned")).status, 0);
  const Said sampled = run_robocd(path(arm, "--from zero --to 0,-1.3 --sampled 0.01"));
  EXPECT_EQ(sampled.status, 0);
  EXPECT_NE(sampled.out.find("the states between them were not tested"), std::string::npos);
  // The path ends where the fore link touches a face of the base: touching collides, so the path is colliding.
  EXPECT_EQ(run_robocd(path(arm, "--from zero --to 0,-1.3125")).status, 1);
  EXPECT_EQ(run_robocd(path(arm, "--from zero --to 0,-1.3 --clearance 0.5")).status, 1);
  const Said open = run_robocd(path(arm, "--from 0,0.9 --to 3.1,-1.3 --min-step 1 --json"));
  ASSERT_EQ(open.status, 4);
  EXPECT_EQ(Json::parse(open.out)["verdict"], "undecided");
}

TEST(RobocdPath, KeepsTheJsonContract) {
  const ArmFolder arm;
  const Said said = run_robocd(path(arm, "--from zero --to 0.5,-1.4 --json"));
  ASSERT_EQ(said.status, 1);
  const Json json = Json::parse(said.out);
  EXPECT_EQ(json["verdict"], "colliding");
  EXPECT_EQ(json["proved"], true);
  EXPECT_EQ(json["joints"], Json({"shoulder", "elbow"}));
  EXPECT_EQ(json["to"]["values"], Json({0.5, -1.4}));
  const double t = json["parameter"].get<double>();
  EXPECT_GT(t, 1.3 / 1.4);
  EXPECT_NEAR(json["values"][1].get<double>(), -1.4 * t, 1e-15);
  ASSERT_FALSE(json["pairs"].empty());
  EXPECT_TRUE(json["pairs"][0].contains("link1"));
  EXPECT_TRUE(json["contact"].contains("distance"));
  const Json free = Json::parse(run_robocd(path(arm, "--from zero --to 0.5,-1 --json")).out);
  EXPECT_EQ(free["verdict"], "free");
  EXPECT_EQ(free["proved"], true);
  EXPECT_TRUE(free["parameter"].is_null());
  EXPECT_TRUE(free["contact"].is_null());
}

TEST(RobocdPath, SeesWhatStandsAround) {
  const ArmFolder arm;
  arm.write("post.stl", test::cube_stl(Vec3(0, 1, 0), 0.03125));
  arm.write("foot.stl", test::cube_stl(Vec3(0.125, 0, 0), 0.03125));
  const std::string half_turn = "--from zero --to 3,0 --env" + arm.file("post.stl");
  const Said hit = run_robocd(path(arm, half_turn + " --json"));
  ASSERT_EQ(hit.status, 1);
  const Json json = Json::parse(hit.out);
  // The cube of the upper link collides with the post.
  EXPECT_NEAR(json["values"][0].get<double>(), 1.5708, 0.13);
  ASSERT_EQ(json["environment_pairs"].size(), 1U);
  EXPECT_EQ(json["environment_pairs"][0]["link"], "upper");
  EXPECT_EQ(json["contact"]["first"], "upper");
  // The two nearest samples are on either side of the post, so sampling reports free.
  EXPECT_EQ(run_robocd(path(arm, half_turn + " --sampled 3")).status, 0);
  EXPECT_EQ(run_robocd(path(arm, "--from zero --to 1,0 --env" + arm.file("post.stl"))).status, 0);
  // The base never moves and touches the foot: every path collides.
  const Json always =
      Json::parse(run_robocd(path(arm, "--from zero --to 1,0 --json --env" + arm.file("foot.stl"))).out);
  EXPECT_EQ(always["verdict"], "colliding");
  EXPECT_EQ(always["environment_pairs"][0]["link"], "base");
}

TEST(RobocdPath, TakesEndsFromFilesAndStates) {
  const ArmFolder arm;
  arm.write("q.csv", "elbow,shoulder\n-1.3,0\n0.25,0.5\n");
  arm.write("one.csv", "elbow,shoulder\n-1.3,0.1\n");
  const std::string q = "@" + (arm.path() / "q.csv").string(), one = "@" + (arm.path() / "one.csv").string();
  const Json rows = Json::parse(run_robocd(path(arm, "--json --from '" + q + ":0' --to '" + q + ":1'")).out);
  EXPECT_EQ(rows["from"]["values"], Json({0.0, -1.3}));
  EXPECT_EQ(rows["to"]["values"], Json({0.5, 0.25}));
  EXPECT_EQ(run_robocd(path(arm, "--from zero --to '" + one + "'")).status, 0);
  EXPECT_EQ(
      refused(arm, "--from zero --to '" + q + "'"),
      "2: robocd: --to '" + q + "': " + q.substr(1) + " has 2 rows, expected a row from " + q + ":0 to " + q + ":1\n");
  EXPECT_EQ(refused(arm, "--from zero --to '" + q + ":2'").substr(0, 2), "2:");
  EXPECT_EQ(refused(arm, "--from zero --to '@" + (arm.path() / "no.csv").string() + "'").substr(0, 2), "3:");
}

TEST(RobocdPath, GoesThroughWaypoints) {
  const ArmFolder arm;
  arm.write("q.csv", "time,elbow,shoulder\n0,0,0\n1,0.5,0.5\n2,-1.5,0.5\n3,0,0\n");
  arm.write("free.csv", "elbow,shoulder\n0,0\n0.5,0.5\n0.25,1\n");
  arm.write("one.csv", "elbow,shoulder\n0,0\n");
  const auto answer = [&](const std::string& file, int status) {
    const auto said = run_robocd("path" + arm.urdf() + " --json --waypoints" + arm.file(file) + " 2>/dev/null");
    EXPECT_EQ(said.status, status);
    return Json::parse(said.out);
  };
  const Json json = answer("q.csv", 1);
  EXPECT_EQ(json["verdict"], "colliding");
  EXPECT_EQ(json["segments"], 3);
  EXPECT_EQ(json["segment"], 1);
  EXPECT_EQ(json["from"]["values"], Json({0.5, 0.5}));
  EXPECT_EQ(json["to"]["values"], Json({0.5, -1.5}));
  EXPECT_GT(json["parameter"], 0.5);
  EXPECT_EQ(json["notes"].size(), 1U);
  const Json free = answer("free.csv", 0);
  EXPECT_EQ(free["verdict"], "free");
  EXPECT_TRUE(free["segment"].is_null());
  EXPECT_EQ(free["to"]["values"], Json({1.0, 0.25}));
  EXPECT_EQ(run_robocd("path" + arm.urdf() + " --waypoints" + arm.file("one.csv") + " 2>&1").status, 2);
  EXPECT_EQ(run_robocd("path" + arm.urdf() + " --from zero --to zero --waypoints" + arm.file("q.csv") + " 2>&1").status,
            2);
  EXPECT_EQ(run_robocd("path" + arm.urdf() + " 2>&1").status, 2);
}

TEST(RobocdPath, RefusesEndsThatDoNotFit) {
  const ArmFolder arm;
  EXPECT_EQ(refused(arm, "--from zero --to 1"),
            "2: robocd: --to '1': 1 values, expected 2, one for each independent joint\n");
  EXPECT_EQ(refused(arm, "--from 0,nan --to 1,1"),
            "2: robocd: --from '0,nan': joint 'elbow' is 'nan', expected a finite number, at most 1e+15\n");
  EXPECT_EQ(refused(arm, "--from zero --to state:all/gone"),
            "2: robocd: --to 'all/gone': expected one of all/turned, slide/in\n");
  for (const char* options : {"--from zero", "--to zero", "--from zero --to zero --sampled 0",
                              "--from zero --to zero --min-step -1", "--from zero --to zero --sampled 1 --min-step 0.1",
                              "--from zero --to zero --clearance -1", "--from zero --to zero --mode any"})
    EXPECT_EQ(refused(arm, options).substr(0, 2), "2:") << options;
  EXPECT_EQ(refused(arm, "--from zero --to zero --env /nonexistent.stl").substr(0, 2), "3:");
  EXPECT_EQ(
      refused(arm, "--from 0,9 --to zero"),
      "0: note: 1 of 2 configurations are outside the joint limits: configuration 0 has 9 for joint 'elbow', limits "
      "-1.5 and 1\n");
}

TEST(RobotPathChecker, RefusesBadStepsEvenWhereABodyAlwaysCollides) {
  RobotDescription description{"post", {{"base", {{BoxShape{Vec3(1, 1, 1)}, Pose{}}}}, {"arm", {}}}, {}};
  JointDescription joint{"turn", JointType::continuous, "base", "arm"};
  joint.axis = Vec3::UnitZ();
  description.joints.push_back(joint);
  const auto robot = std::make_shared<const Robot>(std::move(description));
  const RobotChecker checker(robot, tested_pairs(*robot), LinkMargins(*robot));
  Environment around;
  around.add(BoxShape{Vec3(1, 1, 1)}, Pose{Mat3::Identity(), Vec3(0.5, 0, 0)});
  const std::vector<double> here = {0.0}, there = {1.0};
  PathChecker paths(checker, around);
  EXPECT_EQ(paths.certify(here, there).verdict, PathVerdict::colliding);
  EXPECT_EQ(paths.sample(here, there, 0.1).verdict, PathVerdict::colliding);
  EXPECT_THROW(paths.certify(here, there, 0.0), ConfigurationError);
  EXPECT_THROW(paths.sample(here, there, 0.0), ConfigurationError);
  EXPECT_THROW(paths.certify(here, std::vector<double>{std::nan("")}), ConfigurationError);
}

/// A quarter of the robots each, to keep each test short; with HINGE_TEST_ALL there are 12 000 paths in all.
class RobotPathCheckerSlice : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(All, RobotPathCheckerSlice, testing::Range<std::size_t>(0, 4));

/// Random robots among random bodies, one body attached: every verdict is compared with brute force on states.
TEST_P(RobotPathCheckerSlice, AgreesWithBruteForce) {
  constexpr std::uint64_t seed = 421;
  const std::size_t robots = all_variants() ? 500 : 12, paths_each = all_variants() ? 24 : 16;
  const int states = 1000;
  int free = 0, colliding = 0, undecided = 0;
  for (std::size_t r = GetParam(); r < robots; r += 4) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", robot " + std::to_string(r));
    SampleStream stream(seed, r);
    const auto robot = std::make_shared<const Robot>(test::random_description(stream, 7));
    const double clearance = r % 3 == 0 ? 0.05 : 0.0;
    const auto make = [&](const char* engine) {
      return RobotChecker(robot, tested_pairs(*robot), LinkMargins(*robot, clearance), {engine});
    };
    RobotChecker simd = make("simd"), brute = make("brute");
    Environment around(clearance, "simd"), brute_around(clearance, "brute");
    const bool among_bodies = r % 4 != 3;
    for (std::size_t b = 0; among_bodies && b < 3; ++b) {
      const auto mesh = test::random_mesh(stream, 4, 0.3);
      const Pose pose = test::random_pose(stream, 1.0), in_link = test::random_pose(stream, 0.0);
      for (Environment* environment : {&around, &brute_around}) {
        const BodyId body = environment->add(mesh, pose, "body");
        if (b == 2) environment->attach(body, robot, id<LinkId>(robot->link_count() - 1), in_link);
      }
    }
    PathChecker paths = among_bodies ? PathChecker(simd, around) : PathChecker(simd);
    const auto collides = [&](const std::vector<double>& q, RobotChecker& checker, Environment& environment) {
      checker.update(q);
      return checker.collides() || (among_bodies && checker.collides(environment));
    };
    for (std::size_t k = 0; k < paths_each; ++k) {
      std::vector<double> from(robot->independent_joints().size()), to(from), q(from);
      const double amplitude = std::pow(10.0, test::uniform(stream, -2.0, 0.3));
      for (std::size_t j = 0; j < from.size(); ++j) {
        from[j] = test::uniform(stream, -1.5, 1.5);
        to[j] = from[j] + test::uniform(stream, -amplitude, amplitude);
      }
      const RobotPathAnswer answer = paths.certify(from, to);
      free += answer.is_free();
      colliding += answer.verdict == PathVerdict::colliding;
      undecided += answer.verdict == PathVerdict::undecided;
      if (answer.verdict == PathVerdict::colliding) {
        EXPECT_TRUE(collides(answer.configuration, brute, brute_around));
        EXPECT_TRUE(answer.contact.has_value());
      }
      for (int state = 0; answer.is_free() && state < states; ++state) {
        for (std::size_t j = 0; j < q.size(); ++j) q[j] = from[j] + state / (states - 1.0) * (to[j] - from[j]);
        if (collides(q, simd, around) || (state % 50 == 25 && collides(q, brute, brute_around))) {
          ADD_FAILURE() << "path " << k << " is called free, collides at state " << state;
          break;
        }
      }
    }
  }
  EXPECT_GT(free, static_cast<int>(robots * paths_each / 80));
  EXPECT_GT(colliding, static_cast<int>(robots * paths_each / 80));
  EXPECT_LE(undecided, static_cast<int>(robots * paths_each / 4000));
}

}  // namespace robocd_path_test
}  // namespace hinge::robotics
