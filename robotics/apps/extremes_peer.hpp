// SPDX-License-Identifier: BSD-3-Clause
// ExtremesPeer: another library whose decisions dial --extremes shows. The product has none; bench/peers/robocd_fcl.cpp
// has FCL.
#pragma once

#include <functional>

#include "hinge/robotics/robot_checker.hpp"

namespace robocd {

struct ExtremesPeer {
  const char* name;
  /// Makes a decision about the surfaces of the checker's tested pairs of links, at the poses that the checker has.
  /// Returns an empty function if the library has no such shapes.
  std::function<bool(hinge::robotics::RobotChecker&)> (*make)(const hinge::robotics::RobotChecker&);
};

/// Returns null if this program has none.
const ExtremesPeer* extremes_peer();

}  // namespace robocd
