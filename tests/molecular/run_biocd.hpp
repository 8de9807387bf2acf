// SPDX-License-Identifier: BSD-3-Clause
// Runs biocd as a user would, and keeps what it says.
#pragma once

#include <string>

#include "tool/run_tool.hpp"

namespace hinge::test {

inline Said run_biocd(const std::string& arguments, const std::string& environment = "") {
  return run_tool(HINGE_BIOCD, arguments, environment);
}

}  // namespace hinge::test
