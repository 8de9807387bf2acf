// SPDX-License-Identifier: BSD-3-Clause
// A program that uses the robotics component: a robot of one box, made in code and asked at its only configuration.
#include "hinge/robotics/robotics.hpp"

int main() {
  using namespace hinge::robotics;
  RobotDescription description{"post", {{"base", {{BoxShape{hinge::Vec3(1, 1, 1)}, hinge::Pose{}}}}}, {}};
  const auto robot = std::make_shared<const Robot>(std::move(description));
  RobotChecker checker(robot, tested_pairs(*robot), LinkMargins(*robot));
  return checker.collides() ? 1 : 0;
}
