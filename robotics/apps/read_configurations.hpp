// SPDX-License-Identifier: BSD-3-Clause
// Configurations from a CSV file.
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

/// One value (rad or m) per independent joint, in the robot's order, a configuration a row. The first line names the
/// independent joints, each once, in any order; fields may be in double quotes. Columns with other names (a time, an
/// index) are left out, and `notes` says which. LoadError naming line and column: a missing or repeated joint, one that
/// takes no value, a row of another length, a value that is not a finite number or takes a follower too far, no rows.
std::vector<std::vector<double>> read_configurations(const std::filesystem::path& path,
                                                     const hinge::robotics::Robot& robot,
                                                     std::vector<std::string>& notes);

/// One configuration as a list: values separated by commas, in the robot's order. ModelError: another number of them,
/// one that is not a finite number or takes a follower too far; `what` begins the message.
std::vector<double> read_configuration(const std::string& what, std::string_view list,
                                       const hinge::robotics::Robot& robot);

/// A joint that these values take farther than any value given may be.
struct TooFar {
  std::size_t independent = 0;  // position of the joint that is the cause
  std::string what;             // a sentence without its end
};

/// The first one: a follower, where q holds no value too large itself.
std::optional<TooFar> find_too_far(const hinge::robotics::Robot& robot, std::span<const double> q);

}  // namespace robocd
