// SPDX-License-Identifier: BSD-3-Clause
// urdfdom's reading of a URDF text, with what it complained of.
#pragma once

#include <string>

#include <urdf_world/types.h>

namespace hinge::robotics {

struct Parsed {
  urdf::ModelInterfaceSharedPtr model;  ///< null when refused
  std::string complaint;                ///< its first errors as one line; empty: none
};

/// Also where urdfdom goes on after an error, leaving something out, the complaint is there.
Parsed parse_with_urdfdom(const std::string& text);

}  // namespace hinge::robotics
