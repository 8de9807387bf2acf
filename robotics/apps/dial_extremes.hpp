// SPDX-License-Identifier: BSD-3-Clause
// Extremes: what tiers and single precision get wrong on scaled and displaced copies of a robot that nearly touch.
#pragma once

#include "hinge/robotics/robot_description.hpp"
#include "hinge_tools/dial_report.hpp"
#include "options.hpp"

namespace robocd {

/// Returns the robot with all lengths multiplied by `scale`, a power of two, so that no number is rounded: shapes,
/// origins, limits and values of prismatic joints.
hinge::robotics::RobotDescription scaled(hinge::robotics::RobotDescription robot, double scale);

/// Tries the robot of the job against itself, for about 20 s at most. Bodies around it are left out.
hinge::tool::DialExtremes find_extremes(const Options& options, const Job& job);

}  // namespace robocd
