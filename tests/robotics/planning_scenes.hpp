// SPDX-License-Identifier: BSD-3-Clause
// Scenes for planners: shared robots among boxes, with two free configurations.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "robotics/robots.hpp"

namespace hinge::test {

/// A shared robot, boxes around it, and the ends of a motion, rad or m.
struct PlanningScene {
  std::string name, robot;
  struct Box {
    Vec3 size, at;  // m
  };
  std::vector<Box> boxes;
  std::vector<double> from, to;

  robotics::Environment environment(const std::string& engine = "simd") const {
    robotics::Environment made(0.0, engine);
    for (const Box& box : boxes) made.add(robotics::BoxShape{box.size}, {Mat3::Identity(), box.at}, "board");
    return made;
  }
  /// Tests the robot with exact shapes and the pairs of its SRDF.
  robotics::RobotChecker checker(const std::string& engine = "simd") const {
    const LoadedRobot loaded = load_shared(robot);
    const auto exact = std::make_shared<const robotics::Robot>(loaded.robot.description());
    return {exact, robotics::tested_pairs(*exact, loaded.disabled), robotics::LinkMargins(*exact), {engine}};
  }
};

/// Three boards and three walls: four compartments of 0.6 m x 0.4 m, 0.45 m in front of the robot and 0.35 m deep.
inline std::vector<PlanningScene::Box> shelf_boxes() {
  std::vector<PlanningScene::Box> boxes;
  for (const double z : {0.1, 0.5, 0.9}) boxes.push_back({{0.35, 1.2, 0.02}, {0.625, 0.0, z}});
  for (const double y : {-0.6, 0.0, 0.6}) boxes.push_back({{0.35, 0.02, 0.82}, {0.625, y, 0.5}});
  return boxes;
}

/// Half sitting, with other values of the seven joints of the right arm.
inline std::vector<double> talos_right_arm(const std::vector<double>& arm) {
  const std::vector<double> leg{0.0, 0.0, -0.41, 0.86, -0.45, 0.0};
  std::vector<double> q{0.0, 0.01, 0.0, 0.0, 0.26, 0.17, 0.0, -0.53, 0.0, 0.0, 0.1};
  q.insert(q.end(), arm.begin(), arm.end());
  q.insert(q.end(), {0.0, 0.0});  // grippers
  for (int side = 0; side < 2; ++side) q.insert(q.end(), leg.begin(), leg.end());
  return q;
}

/// From one compartment of the shelf to another, and an arm that goes from below a table to its top, past a post.
inline std::vector<PlanningScene> planning_scenes() {
  return {{"panda-shelf",
           "panda",
           shelf_boxes(),
           {0.70, 1.72, -2.28, -0.37, 1.88, 3.06, -2.21, 0.02},
           {0.01, 0.89, -1.39, -0.57, -0.73, 3.63, -1.72, 0.02}},
          {"ur5-shelf",
           "ur5_robotiq",
           shelf_boxes(),
           {2.12, 2.32, -0.22, -2.19, -0.81, 1.86},
           {-2.26, 0.64, 0.41, -1.48, 0.67, -0.98}},
          {"talos-table",
           "talos",
           {{{0.5, 1.4, 0.04}, {0.6, 0.0, 0.0}}, {{0.06, 0.06, 0.6}, {0.45, -0.25, 0.3}}},
           talos_right_arm({0.92, -0.58, 1.14, -0.78, -0.64, -0.99, 0.15}),
           talos_right_arm({0.63, -1.53, 0.27, -1.46, -0.83, -0.08, 0.59})}};
}

}  // namespace hinge::test
