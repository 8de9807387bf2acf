// SPDX-License-Identifier: BSD-3-Clause
// parse_with_urdfdom: parses a URDF text with urdfdom and returns its error messages.
#pragma once

#include <string>

#include <urdf_world/types.h>

namespace hinge::robotics {

/// The result of parse_with_urdfdom().
struct Parsed {
  urdf::ModelInterfaceSharedPtr model;  ///< null if refused
  std::string complaint;                ///< first errors in one line; empty: none
};

/// Parses a URDF text. The complaint is also set if urdfdom skips an element after an error. Thread-safe.
Parsed parse_with_urdfdom(const std::string& text);

}  // namespace hinge::robotics
