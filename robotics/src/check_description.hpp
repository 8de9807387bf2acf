// SPDX-License-Identifier: BSD-3-Clause
// The first thing wrong with a description, as Robot refuses it and as the URDF reader reports it with its line.
#pragma once

#include <optional>
#include <string>

#include "hinge/robotics/robot_description.hpp"

namespace hinge::robotics {

struct Problem {
  int line = 0;  ///< of the link or joint at fault; 0: unknown
  std::string what;
};

/// No links; empty or repeated names; joints to links that do not exist; links with two parents, on a cycle or apart
/// from the rest; origins that are no rigid placement; axes, limits and mimic factors that are zero or not finite;
/// mimics of unknown joints or in a circle; sizes, scales and vertices no shape has.
std::optional<Problem> first_problem(const RobotDescription& robot);

/// Of those, what concerns names and tree alone.
std::optional<Problem> tree_problem(const RobotDescription& robot);

/// The same for a shape, to go behind the name of its link; empty when there is none.
std::string problem_of(const Shape& shape);

}  // namespace hinge::robotics
