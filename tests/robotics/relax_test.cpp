// SPDX-License-Identifier: BSD-3-Clause
// relax: the result is free by brute force and near the start; robocd relax: its output, its file, what is refused.
#include "hinge/robotics/relax.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/robotics/random_configuration.hpp"
#include "robotics/random_robot.hpp"
#include "robotics/robots.hpp"
#include "robotics/run_robocd.hpp"

namespace hinge::robotics {
namespace relax_test {

using Json = nlohmann::json;
using test::run_robocd;

constexpr std::uint64_t seed = 97;

/// A cube that slides along x, and one that turns on it.
RobotDescription slider() {
  RobotDescription robot{
      "slider", {{"root"}, {"cube", {{BoxShape{{1.0, 1.0, 1.0}}}}}, {"arm", {{BoxShape{{0.1, 0.1, 0.1}}}}}}, {}};
  robot.joints.push_back({"slide", JointType::prismatic, "root", "cube"});
  robot.joints.back().axis = Vec3::UnitX();
  robot.joints.back().lower = -5.0;
  robot.joints.back().upper = 5.0;
  robot.joints.push_back({"turn", JointType::continuous, "cube", "arm"});
  robot.joints.back().origin.translation = Vec3(0.0, 0.0, 0.6);
  return robot;
}

TEST(RelaxRobot, GoesBackToTheNearestFreePlace) {
  const auto robot = std::make_shared<const Robot>(slider());
  RobotChecker checker(robot, tested_pairs(*robot), LinkMargins(*robot));
  Environment environment(0.0, "simd");
  environment.add(BoxShape{{1.0, 9.0, 9.0}}, {Mat3::Identity(), Vec3(3.0, 0.0, 0.0)}, "wall");
  for (const double x : {2.01, 2.3, 2.9}) {
    const Relaxation relaxed = relax(checker, &environment, std::vector<double>{x, 0.7});
    ASSERT_TRUE(relaxed.is_free) << x;
    EXPECT_LT(relaxed.q[0], 2.0);
    EXPECT_GT(relaxed.q[0], 1.999) << x;
    EXPECT_EQ(relaxed.q[1], 0.7);  // it turns nothing that collides
    EXPECT_NEAR(relaxed.distance, x - relaxed.q[0], 1e-12);
  }
  // Beyond the middle of the wall.
  const Relaxation far = relax(checker, &environment, std::vector<double>{3.8, 0.0});
  ASSERT_TRUE(far.is_free);
  EXPECT_GT(far.q[0], 4.0);
  EXPECT_LT(far.q[0], 4.001);
}

TEST(RelaxRobot, FindsConfigurationsThatAreFreeByBruteForce) {
  std::size_t found = 0, tried = 0;
  for (std::uint64_t number = 0; number < 12; ++number) {
    SampleStream stream(seed, number);
    const auto robot = std::make_shared<const Robot>(test::random_description(stream, 7));
    RobotChecker checker(robot, tested_pairs(*robot), LinkMargins(*robot)),
        brute(robot, tested_pairs(*robot), LinkMargins(*robot), {"brute"});
    Environment bodies(0.0, "simd"), slow(0.0, "brute");
    for (Environment* environment : {&bodies, &slow})
      environment->add(SphereShape{0.2}, {Mat3::Identity(), Vec3(0.9, 0.3, 0.4)}, "ball");
    for (std::uint64_t k = 0; k < 60; ++k) {
      std::vector<double> q(robot->independent_joints().size());
      random_configuration(*robot, seed, k, q);
      brute.update(q);
      if (!brute.collides() && !brute.collides(slow)) continue;
      ++tried;
      RelaxOptions few;
      few.most_tries = 3000;
      const Relaxation relaxed = relax(checker, &bodies, q, few);
      EXPECT_LE(relaxed.tries, 3000U);
      brute.update(relaxed.q);
      EXPECT_EQ(relaxed.is_free, !brute.collides() && !brute.collides(slow));
      if (!relaxed.is_free) {
        EXPECT_EQ(relaxed.q, q);
        continue;
      }
      ++found;
      double sum = 0.0;
      for (std::size_t j = 0; j < q.size(); ++j) {
        sum += (relaxed.q[j] - q[j]) * (relaxed.q[j] - q[j]);
        EXPECT_GE(relaxed.q[j], robot->lower()[j]);
        EXPECT_LE(relaxed.q[j], robot->upper()[j]);
      }
      EXPECT_NEAR(relaxed.distance, std::sqrt(sum), 1e-12);
      EXPECT_EQ(relax(checker, &bodies, q, few).q, relaxed.q);  // depends on the arguments alone
      // No nearer free configuration among random ones.
      std::size_t nearer = 0;
      for (int sample = 0; sample < 200; ++sample) {
        std::vector<double> other(q);
        for (double& value : other)
          value += 0.5 * relaxed.distance * stream.normal() / std::sqrt(static_cast<double>(q.size()));
        brute.update(other);
        if (!brute.collides() && !brute.collides(slow)) ++nearer;
      }
      EXPECT_LT(nearer, 20U);
    }
  }
  EXPECT_GT(tried, 100U);
  EXPECT_GT(found, tried / 2);
}

TEST(RelaxRobot, SaysWhenNothingCanBeDone) {
  const auto robot = std::make_shared<const Robot>(slider());
  RobotChecker checker(robot, tested_pairs(*robot), LinkMargins(*robot));
  const std::vector<double> start{1.0, 0.0};
  const Relaxation nothing = relax(checker, nullptr, start);
  EXPECT_TRUE(nothing.is_free);
  EXPECT_EQ(nothing.q, start);
  EXPECT_EQ(nothing.tries, 1U);
  EXPECT_EQ(nothing.distance, 0.0);
  Environment everywhere(0.0, "simd");
  everywhere.add(BoxShape{{99.0, 9.0, 9.0}}, {}, "room");
  RelaxOptions few;
  few.most_tries = 500;
  const Relaxation hopeless = relax(checker, &everywhere, start, few);
  EXPECT_FALSE(hopeless.is_free);
  EXPECT_EQ(hopeless.q, start);
  EXPECT_EQ(hopeless.tries, 500U);
  int calls = 0;
  const Relaxation stopped = relax(checker, &everywhere, start, {}, [&] { return ++calls == 5; });
  EXPECT_TRUE(stopped.stopped);
  EXPECT_FALSE(stopped.is_free);
  few.most_tries = 0;
  EXPECT_THROW(relax(checker, nullptr, start, few), ModelError);
  EXPECT_THROW(relax(checker, nullptr, std::vector<double>{1.0}), ConfigurationError);
  EXPECT_THROW(relax(checker, nullptr, std::vector<double>{1.0, std::nan("")}), ConfigurationError);
}

TEST(RobocdRelax, WritesAFreeConfiguration) {
  const std::string data = std::string(HINGE_SOURCE_DIR) + "/robotics/data/";
  const std::string arm = "relax " + data + "arm.urdf --srdf " + data + "arm.srdf ";
  const test::TemporaryFolder folder;
  const std::string file = (folder.path() / "free.csv").string();
  const std::string shelf = " --env shelf=" + data + "shelf.obj,xyz='0 0 -0.15',rpy='0 0 0.1' ";
  const auto said = run_robocd(arm + "--from state:arm/reach" + shelf + "--json --out " + file);
  ASSERT_EQ(said.status, 0) << said.out;
  const Json json = Json::parse(said.out);
  EXPECT_TRUE(json.at("before").at("collides"));
  EXPECT_FALSE(json.at("after").at("collides"));
  EXPECT_GT(json.at("distance").get<double>(), 0.0);
  EXPECT_LT(json.at("distance").get<double>(), 0.5);
  EXPECT_EQ(run_robocd("check " + data + "arm.urdf --srdf " + data + "arm.srdf" + shelf + "--csv-in " + file).status,
            0);
  EXPECT_EQ(run_robocd("check " + data + "arm.urdf --srdf " + data + "arm.srdf" + shelf + "--state arm/reach").status,
            1);
  // The file that the start comes from is an input, so it is not replaced.
  EXPECT_EQ(run_robocd(arm + "--from @" + file + " --out " + file + " 2>/dev/null").status, 2);
  EXPECT_EQ(run_robocd(arm + "--from @" + file + ":0 --out " + file + " 2>/dev/null").status, 2);
  const auto table = run_robocd(arm + "--from state:arm/reach" + shelf + "2>&1");
  EXPECT_NE(table.out.find("after: free"), std::string::npos) << table.out;
  const auto hopeless = run_robocd(arm + "--from zero --env box:'9 9 9' --tries 50 2>&1");
  EXPECT_EQ(hopeless.status, 1);
  EXPECT_NE(hopeless.out.find("no free configuration in"), std::string::npos) << hopeless.out;
  EXPECT_EQ(run_robocd(arm + "--from state:arm/nowhere 2>/dev/null").status, 2);
  EXPECT_EQ(run_robocd(arm + "--from zero --tries 0 2>/dev/null").status, 2);
  EXPECT_EQ(run_robocd(arm + "2>/dev/null").status, 2);
}

}  // namespace relax_test
}  // namespace hinge::robotics
