// SPDX-License-Identifier: BSD-3-Clause
// From a robot description (read_urdf returns the same type) to collision results, for the robot alone and with
// obstacles.
#include <hinge/robotics/environment.hpp>
#include <hinge/robotics/link_margins.hpp>
#include <hinge/robotics/robot.hpp>
#include <hinge/robotics/robot_checker.hpp>
#include <hinge/robotics/tested_pairs.hpp>
#include <memory>
#include <numbers>

int main() {
  using namespace hinge::robotics;
  RobotDescription arm{.name = "arm", .links = {}, .joints = {}};
  const hinge::Pose middle{hinge::Mat3::Identity(), {0.25, 0, 0}}, end{hinge::Mat3::Identity(), {0.5, 0, 0}};
  for (const char* name : {"base", "upper", "fore"})
    arm.links.push_back({.name = name, .geometry = {{BoxShape{{0.4, 0.1, 0.1}}, middle}}});
  for (int k = 0; k < 2; ++k)
    arm.joints.push_back({.name = k == 0 ? "shoulder" : "elbow",
                          .type = JointType::revolute,
                          .parent = arm.links[static_cast<std::size_t>(k)].name,
                          .child = arm.links[static_cast<std::size_t>(k) + 1].name,
                          .origin = end,
                          .axis = {0, 0, 1},
                          .lower = -3.1,
                          .upper = 3.1});
  const auto robot = std::make_shared<const Robot>(arm);

  // Links joined by a joint are not tested; SRDF files exclude more pairs. Links closer than 5 mm collide.
  RobotChecker checker(robot, tested_pairs(*robot), LinkMargins(*robot, 0.005));
  const double q[] = {0.5, -2.0};
  checker.update(q);
  const bool straight_is_free = !checker.collides();

  const double folded[] = {2.0 * std::numbers::pi / 3.0, 2.0 * std::numbers::pi / 3.0};  // the links form a triangle
  checker.update(folded);
  const bool folded_collides = checker.collides() && checker.colliding_links().size() == 1;

  Environment room(0.005);
  const hinge::Triangle sheet{{1.2, -1, -1}, {1.2, 1, -1}, {1.2, 0, 2}};
  const BodyId wall = room.add(std::make_shared<const TriangleMesh>(TriangleMesh{{sheet}}), {}, "wall");
  const double stretched[] = {0.0, 0.0};
  checker.update(stretched);
  const bool wall_is_hit = checker.collides(room);
  room.set_pose(wall, {hinge::Mat3::Identity(), {1.0, 0, 0}});  // no tree is rebuilt
  const auto gap = checker.closest(room);                       // link, obstacle, distance, and a point on each
  return straight_is_free && folded_collides && wall_is_hit && gap && gap->distance > 0.7 ? 0 : 1;
}
