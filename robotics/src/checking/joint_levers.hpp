// SPDX-License-Identifier: BSD-3-Clause
// joint_levers: how far each joint moves a robot. robot_size: how large it is.
#pragma once

#include <span>
#include <vector>

#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// Returns for each independent joint how far it moves the farthest point of the robot, m per rad or m: a mean over
/// random configurations between the bounds, at least a hundredth of the largest one, and above 0. lower, upper: one
/// value per independent joint.
std::vector<double> joint_levers(const Robot& robot, std::span<const double> lower, std::span<const double> upper);

/// Returns the diagonal of the robot's box with every joint at 0, m.
double robot_size(const Robot& robot);

}  // namespace hinge::robotics
