// SPDX-License-Identifier: BSD-3-Clause
// Finds the first fault of a description, for Robot and for the URDF reader, which adds the line.
#pragma once

#include <optional>
#include <string>

#include "hinge/robotics/robot_description.hpp"

namespace hinge::robotics {

/// A fault of a description.
struct Problem {
  int line = 0;  ///< line of the faulty link or joint; 0: unknown
  std::string what;
};

/// Returns the first fault, or nothing. Faults: no links; empty or repeated names; joints to links that do not exist;
/// links with two parents, on a cycle or not connected; origins that are not rigid; zero axes; axes, limits and mimic
/// factors that are not finite; lower limits above upper limits; mimics of joints that are unknown or fixed, or in a
/// cycle; sizes that are negative or above 2^1000; meshes with scale 0, without triangles, or with vertices that are
/// not finite.
std::optional<Problem> first_problem(const RobotDescription& robot);

/// Returns the first of these faults that concerns names or the tree, or nothing.
std::optional<Problem> tree_problem(const RobotDescription& robot);

/// Returns the fault of a shape as text to follow the name of its link, or "".
std::string problem_of(const Shape& shape);

/// Returns a description of a shape that is a point, a segment or flat, such as "sphere of radius 0". Returns "" for
/// other shapes and for meshes.
std::string without_volume(const Shape& shape);

}  // namespace hinge::robotics
