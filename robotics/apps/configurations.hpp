// SPDX-License-Identifier: BSD-3-Clause
// Configurations: the configurations to check, from any source.
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "options.hpp"

namespace robocd {

/// `at` returns one value (rad or m) per independent joint. It depends only on k, so any thread may call it.
struct Configurations {
  std::size_t count = 0;
  std::function<std::vector<double>(std::size_t k)> at;
  std::vector<std::string> notes{};  // about the file of the configurations
};

/// Makes the configurations that the options ask for. Throws LoadError if a CSV file does not fit the robot, or limits
/// are too large to sample. Throws ModelError if the SRDF does not have a state, or a state sets a joint too far.
Configurations find_configurations(const Options& options, const Job& job);

/// Throws LoadError if limits are too large to sample between them.
void check_limits(const Options& options, const hinge::robotics::Robot& robot);

/// Returns the configuration of the given states (GROUP/NAME): later states override earlier ones, all other values are
/// 0. Throws ModelError, naming the option, if the SRDF does not have a state, or a state sets a joint too far.
std::vector<double> join_states(const char* option, const std::vector<std::string>& states, const Options& options,
                                const Job& job);

/// Returns a sentence with the number of configurations outside the joint limits and the first of them, or nothing if
/// all are inside. Such configurations are checked nevertheless, except with --proved-apart: its pairs are proved apart
/// within the limits only, so then they are a LoadError.
std::vector<std::string> notes_on_limits(const Configurations& configurations, const Options& options,
                                         const hinge::robotics::Robot& robot);

/// Writes the first line and a row of a file for --csv-in. q: one value per independent joint.
void write_header(std::ostream& out, const hinge::robotics::Robot& robot);
void write_row(std::ostream& out, const std::vector<double>& q);

}  // namespace robocd
