// SPDX-License-Identifier: BSD-3-Clause
// plan: every motion of a robot is free by brute force, ends at the given values, keeps the limits, and is the same for
// every engine and thread; what has no motion is said.
#include "hinge/robotics/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge/robotics/random_configuration.hpp"
#include "robotics/planning_scenes.hpp"
#include "robotics/random_robot.hpp"

namespace hinge::robotics {
namespace plan_test {

constexpr std::uint64_t seed = 2311;

/// A cube that slides along x and y.
RobotDescription sliders() {
  RobotDescription robot{"sliders", {{"root"}, {"rail"}, {"cube", {{BoxShape{{0.2, 0.2, 0.2}}}}}}, {}};
  for (const auto& [name, parent, child] : {std::array{"x", "root", "rail"}, std::array{"y", "rail", "cube"}}) {
    robot.joints.push_back({name, JointType::prismatic, parent, child});
    robot.joints.back().axis = name[0] == 'x' ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitY());
    robot.joints.back().lower = -2.0;
    robot.joints.back().upper = 2.0;
  }
  return robot;
}

/// A wall between left and right, from y = -3 to `top`.
Environment make_wall(const std::string& engine, double top) {
  Environment made(0.0, engine);
  made.add(BoxShape{{0.1, 3.0 + top, 1.0}}, {Mat3::Identity(), Vec3(0.0, (top - 3.0) / 2, 0.0)}, "wall");
  return made;
}

RobotChecker make_checker(const std::shared_ptr<const Robot>& robot, const std::string& engine) {
  return {robot, tested_pairs(*robot), LinkMargins(*robot), {engine}};
}

/// Tests states of the motion by brute force, among bodies of the engine brute.
void expect_free(const PlannedMotion& motion, RobotChecker& brute, Environment bodies, int states) {
  for (std::size_t w = 0; w < motion.waypoints.size(); ++w) {
    const std::vector<double>&b = motion.waypoints[w], &a = motion.waypoints[w == 0 ? 0 : w - 1];
    for (int s = 1; s <= states; ++s) {
      const double t = static_cast<double>(s) / states;
      std::vector<double> q(a.size());
      for (std::size_t k = 0; k < q.size(); ++k) q[k] = s == states ? b[k] : a[k] + t * (b[k] - a[k]);
      brute.update(q);
      EXPECT_FALSE(brute.collides() || brute.collides(bodies)) << "waypoint " << w << ", t " << t;
    }
  }
}

/// Joints are within their limits, or between a limit and an end that is outside. Continuous joints are at most half a
/// turn beyond the ends.
void expect_limits(const PlannedMotion& motion, const Robot& robot, const std::vector<double>& from,
                   const std::vector<double>& to) {
  for (const std::vector<double>& q : motion.waypoints)
    for (std::size_t j = 0; j < q.size(); ++j) {
      const auto [least, most] = std::minmax(from[j], to[j]);
      const bool turns = robot.description().joints[robot.independent_joints()[j]].type == JointType::continuous;
      EXPECT_GE(q[j], turns ? least - std::numbers::pi : std::min(robot.lower()[j], least));
      EXPECT_LE(q[j], turns ? most + std::numbers::pi : std::max(robot.upper()[j], most));
    }
}

TEST(PlanRobot, GoesAroundAWall) {
  const auto robot = std::make_shared<const Robot>(sliders());
  const RobotChecker checker = make_checker(robot, "simd");
  RobotChecker brute = make_checker(robot, "brute");
  const std::vector<double> from{-1.0, 0.0}, to{1.0, 0.0};
  for (std::uint64_t k = 1; k <= 20; ++k) {
    SCOPED_TRACE(k);
    const Environment bodies = make_wall("simd", 1.0);
    const PlannedMotion motion = plan(checker, &bodies, from, to, {.seed = k});
    ASSERT_TRUE(motion.reached);
    EXPECT_EQ(motion.waypoints.front(), from);
    EXPECT_EQ(motion.waypoints.back(), to);
    EXPECT_EQ(motion.remaining, 0.0);
    EXPECT_NEAR(motion.straight, 2.0, 1e-12);  // a prismatic joint moves the cube by 1 m per m
    // Around the corner: over (-0.15, 1.1) and (0.15, 1.1).
    const double shortest = 2 * std::hypot(0.85, 1.1) + 0.3;
    EXPECT_GE(motion.length, shortest);
    EXPECT_LT(motion.length, 1.25 * shortest);
    expect_free(motion, brute, make_wall("brute", 1.0), 40);
    expect_limits(motion, *robot, from, to);
  }
}

TEST(PlanRobot, MotionsOfRandomRobotsAreFreeByBruteForce) {
  RecordProperty("seed", static_cast<int>(seed));
  const std::uint64_t robots = std::getenv("HINGE_TEST_ALL") != nullptr ? 40 : 8;
  std::size_t reached = 0, detours = 0;
  for (std::uint64_t number = 0; number < robots; ++number) {
    SampleStream stream(seed, number);
    const auto robot = std::make_shared<const Robot>(test::random_description(stream, 6));
    const RobotChecker checker = make_checker(robot, "simd");
    RobotChecker brute = make_checker(robot, "brute");
    Environment bodies(0.0, "simd"), slow(0.0, "brute");
    for (Environment* environment : {&bodies, &slow})
      environment->add(SphereShape{0.3}, {Mat3::Identity(), Vec3(0.7, 0.2, 0.3)}, "ball");
    std::vector<std::vector<double>> ends;
    for (std::uint64_t k = 0; ends.size() < 4 && k < 2000; ++k) {
      std::vector<double> q(robot->independent_joints().size());
      random_configuration(*robot, seed, k, q);
      brute.update(q);
      if (!brute.collides() && !brute.collides(slow)) ends.push_back(q);
    }
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      SCOPED_TRACE("robot " + std::to_string(number) + ", ends " + std::to_string(k));
      const PlannedMotion motion = plan(checker, &bodies, ends[k], ends[k + 1], {.most_motions = 500});
      EXPECT_EQ(motion.waypoints.front(), ends[k]);
      EXPECT_EQ(motion.waypoints.back() == ends[k + 1], motion.reached);
      EXPECT_EQ(motion.remaining == 0.0, motion.reached);
      expect_free(motion, brute, slow, 12);
      expect_limits(motion, *robot, ends[k], ends[k + 1]);
      reached += motion.reached ? 1 : 0;
      detours += motion.reached && motion.waypoints.size() > 2 ? 1 : 0;
    }
  }
  EXPECT_GE(reached, robots);
  EXPECT_GE(detours, robots / 4);
}

TEST(PlanRobot, DependsOnTheArgumentsAlone) {
  const auto robot = std::make_shared<const Robot>(sliders());
  const std::vector<double> from{-1.0, 0.0}, to{1.0, 0.0};
  const auto ask = [&](const std::string& engine) {
    const Environment bodies = make_wall(engine, 1.0);
    return plan(make_checker(robot, engine), &bodies, from, to).waypoints;
  };
  const auto expected = ask("simd");
  EXPECT_GT(expected.size(), 2U);
  EXPECT_EQ(ask("simd"), expected);
  EXPECT_EQ(ask("lazy"), expected);
  EXPECT_EQ(ask("brute"), expected);
  std::vector<std::vector<std::vector<double>>> found(2);
  std::thread first([&] { found[0] = ask("simd"); }), second([&] { found[1] = ask("lazy"); });
  first.join();
  second.join();
  EXPECT_EQ(found[0], expected);
  EXPECT_EQ(found[1], expected);
  const Environment bodies = make_wall("simd", 1.0);
  EXPECT_NE(plan(make_checker(robot, "simd"), &bodies, from, to, {.seed = 2}).waypoints, expected);
}

TEST(PlanRobot, UsesOnePathCheckerForManyMotions) {
  const auto robot = std::make_shared<const Robot>(sliders());
  const RobotChecker checker = make_checker(robot, "simd");
  const std::vector<double> from{-1.0, 0.0}, to{1.0, 0.0}, inside{0.0, 0.0};
  std::optional<PathChecker> paths;
  {
    Environment bodies = make_wall("simd", 1.0);
    paths.emplace(checker, bodies);
    bodies.set_pose(bodies.bodies().front(), {Mat3::Identity(), Vec3(9.0, 0.0, 0.0)});  // the copy stays
  }
  EXPECT_TRUE(paths->is_free(from));
  EXPECT_FALSE(paths->is_free(inside));
  EXPECT_THROW(paths->is_free(std::vector<double>{1.0}), ConfigurationError);
  EXPECT_EQ(&paths->checker().robot(), robot.get());
  ASSERT_NE(paths->environment(), nullptr);
  EXPECT_EQ(paths->environment()->bodies().size(), 1U);
  EXPECT_EQ(PathChecker(checker).environment(), nullptr);
  const Environment bodies = make_wall("simd", 1.0);
  PathChecker copy = *paths;
  for (std::uint64_t k = 1; k <= 5; ++k) {
    const auto expected = plan(checker, &bodies, from, to, {.seed = k}).waypoints;
    EXPECT_EQ(plan(*paths, from, to, {.seed = k}).waypoints, expected);
    EXPECT_EQ(plan(copy, from, to, {.seed = k}).waypoints, expected);
  }
}

TEST(PlanRobot, SaysThatThereIsNone) {
  const auto robot = std::make_shared<const Robot>(sliders());
  const RobotChecker checker = make_checker(robot, "simd");
  RobotChecker brute = make_checker(robot, "brute");
  Environment closed = make_wall("simd", 3.0);  // from limit to limit
  const std::vector<double> from{-1.0, 0.0}, to{1.0, 0.0};
  const PlannedMotion motion = plan(checker, &closed, from, to, {.most_motions = 300});
  EXPECT_FALSE(motion.reached);
  EXPECT_FALSE(motion.stopped);
  EXPECT_GE(motion.remaining, 1.15);
  EXPECT_LE(motion.remaining, motion.straight);
  EXPECT_GE(motion.motions, 300U);
  EXPECT_LT(motion.motions, 1000U);
  expect_free(motion, brute, make_wall("brute", 3.0), 20);
  std::uint64_t calls = 0;
  const PlannedMotion stopped =
      plan(checker, &closed, from, to, {.most_motions = std::numeric_limits<std::uint64_t>::max()},
           [&] { return ++calls > 1000; });
  EXPECT_TRUE(stopped.stopped);
  EXPECT_FALSE(stopped.reached);
  EXPECT_LT(stopped.remaining, 0.75 * stopped.straight);  // what was found is kept
  expect_free(stopped, brute, make_wall("brute", 3.0), 20);
}

TEST(PlanRobot, CarriesWhatIsHeld) {
  const auto robot = std::make_shared<const Robot>(sliders());
  const RobotChecker checker = make_checker(robot, "simd");
  const std::vector<double> from{-1.0, 0.0}, to{1.0, 0.0};
  // The stick, 0.9 m long, hangs 0.45 m below the middle of the cube, so the cube passes at y above 0.95.
  const auto bodies = [&](const std::string& engine) {
    Environment made = make_wall(engine, 0.5);
    const BodyId stick = made.add(BoxShape{{0.05, 0.9, 0.05}}, Pose{}, "stick");
    made.attach(stick, robot, robot->find_link("cube").value(), {Mat3::Identity(), Vec3(0.0, 0.0, 0.2)});
    return made;
  };
  const Environment held = bodies("simd");
  const PlannedMotion motion = plan(checker, &held, from, to);
  ASSERT_TRUE(motion.reached);
  double highest = 0.0;
  for (const std::vector<double>& q : motion.waypoints) highest = std::max(highest, q[1]);
  EXPECT_GE(highest, 0.95);
  RobotChecker brute = make_checker(robot, "brute");
  expect_free(motion, brute, bodies("brute"), 40);
}

TEST(PlanRobot, RefusesBadArguments) {
  const auto robot = std::make_shared<const Robot>(sliders());
  const RobotChecker checker = make_checker(robot, "simd");
  const Environment bodies = make_wall("simd", 1.0), other = make_wall("brute", 1.0);
  const std::vector<double> good{-1.0, 0.0}, inside{0.0, 0.0};
  EXPECT_THROW(plan(checker, &bodies, good, std::vector<double>{1.0}), ConfigurationError);
  EXPECT_THROW(plan(checker, &bodies, std::vector<double>{NAN, 0.0}, good), ConfigurationError);
  EXPECT_THROW(plan(checker, &bodies, good, good, {.most_motions = 0}), ModelError);
  EXPECT_THROW(plan(checker, &other, good, good), ModelError);
  try {
    plan(checker, &bodies, good, inside);
    FAIL() << "expected an error";
  } catch (const ConfigurationError& error) {
    EXPECT_EQ(std::string(error.what()), "the end collides: link 'cube' and body 'wall'");
  }
  EXPECT_TRUE(plan(checker, &bodies, good, good).reached);
}

TEST(PlanRobot, SolvesTheScenesOfTheBench) {
  if (!std::filesystem::exists(test::shared_folder("panda"))) GTEST_SKIP() << "the shared robots are not there";
  for (const test::PlanningScene& scene : test::planning_scenes()) {
    SCOPED_TRACE(scene.name);
    const Environment bodies = scene.environment(), slow = scene.environment("lazy");
    const RobotChecker checker = scene.checker();
    const PlannedMotion motion = plan(checker, &bodies, scene.from, scene.to);
    EXPECT_TRUE(motion.reached);
    EXPECT_GT(motion.waypoints.size(), 2U);
    RobotChecker lazy = scene.checker("lazy");
    expect_free(motion, lazy, slow, std::getenv("HINGE_TEST_ALL") != nullptr ? 40 : 5);
    expect_limits(motion, checker.robot(), scene.from, scene.to);
  }
}

}  // namespace plan_test
}  // namespace hinge::robotics
