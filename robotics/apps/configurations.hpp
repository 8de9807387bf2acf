// SPDX-License-Identifier: BSD-3-Clause
// The configurations that are to be checked, wherever they come from.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "options.hpp"

namespace robocd {

/// Each is one value (rad or m) per independent joint of the robot; pure in k, so that any thread may ask for any.
struct Configurations {
  std::size_t count = 0;
  std::function<std::vector<double>(std::size_t k)> at;
  std::vector<std::string> notes{};  // on the file they come from
};

/// LoadError: a CSV file or SRDF that does not fit the robot, limits too far away to sample between. ModelError: a
/// state that the SRDF does not have, or that takes a joint too far.
Configurations find_configurations(const Options& options, const Job& job);

/// LoadError: limits too far away to sample between.
void check_limits(const Options& options, const hinge::robotics::Robot& robot);

/// Zero but for what the states (GROUP/NAME) say, later ones over earlier ones. ModelError, naming the option: a state
/// that the SRDF does not have.
std::vector<double> join_states(const char* option, const std::vector<std::string>& states, const Options& options,
                                const Job& job);

/// A sentence when joints are outside their limits, with the first of them; nothing when none is. They are checked all
/// the same.
std::vector<std::string> notes_on_limits(const Configurations& configurations, const hinge::robotics::Robot& robot);

}  // namespace robocd
