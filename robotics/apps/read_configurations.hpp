// SPDX-License-Identifier: BSD-3-Clause
// read_configurations: reads configurations from a CSV file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/robotics/robot.hpp"

namespace robocd {

/// Returns one configuration per row: one value (rad or m) per independent joint, in the robot's order. The first line
/// names the independent joints, each once, in any order; fields may be in double quotes. Columns with other names,
/// such as a time or an index, are skipped with a note. Throws LoadError, naming line and column, for a missing or
/// repeated joint, a joint that takes no value, a row of wrong length, a value that is not a finite number or sets a
/// mimic joint too far, and a file without rows.
std::vector<std::vector<double>> read_configurations(const std::filesystem::path& path,
                                                     const hinge::robotics::Robot& robot,
                                                     std::vector<std::string>& notes);

/// Returns one configuration from a list of values separated by commas, in the robot's order. Throws ModelError, with a
/// message that begins with `what`, if their number is wrong, or a value is not a finite number or sets a mimic joint
/// too far.
std::vector<double> read_configuration(const std::string& what, std::string_view list,
                                       const hinge::robotics::Robot& robot);

/// A joint whose value exceeds the largest one that may be given.
struct TooFar {
  std::size_t independent = 0;  // index into independent_joints() of the joint that causes it
  std::string what;             // a sentence without a full stop
};

/// Returns the first DOF (an independent or mimic joint) whose value is too large for configuration q, or nothing.
std::optional<TooFar> find_too_far(const hinge::robotics::Robot& robot, std::span<const double> q);

}  // namespace robocd
