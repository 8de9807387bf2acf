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
/// from the rest; origins that are no rigid placement; axes that are zero; axes, limits and mimic factors that are not
/// finite; mimics of unknown joints or in a circle; sizes below 0, scales of 0, vertices that are not finite.
std::optional<Problem> first_problem(const RobotDescription& robot);

/// Of those, what concerns names and tree alone.
std::optional<Problem> tree_problem(const RobotDescription& robot);

/// The same for a shape, to go behind the name of its link; empty when there is none.
std::string problem_of(const Shape& shape);

/// A shape that is a point, a segment or flat, for a note: "sphere of radius 0". Empty for others and for meshes.
std::string without_volume(const Shape& shape);

}  // namespace hinge::robotics
