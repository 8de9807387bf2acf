// SPDX-License-Identifier: BSD-3-Clause
// Which links of a robot collide when all joints are at zero? Argument: a URDF file.
#include <cstdio>
#include <memory>
#include <vector>

#include "hinge/robotics/robotics.hpp"

int main(int argc, char** argv) {
  using namespace hinge::robotics;
  if (argc != 2) return 2;
  const auto robot = std::make_shared<const Robot>(read_urdf(argv[1]));
  RobotChecker checker(robot, tested_pairs(*robot), LinkMargins(*robot));
  checker.update(std::vector<double>(robot->independent_joints().size(), 0.0));  // rad
  for (const LinkContact& pair : checker.colliding_links())
    std::printf("%s - %s\n", robot->link_name(pair.link1).c_str(), robot->link_name(pair.link2).c_str());
  std::printf("%s\n", checker.collides() ? "collides" : "free");
}
