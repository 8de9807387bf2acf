// SPDX-License-Identifier: BSD-3-Clause
// Runs biocd as a user would, and returns its output.
#pragma once

#include <string>

#include "tool/run_tool.hpp"

namespace hinge::test {

/// Runs biocd with these arguments through the shell. environment: assignments such as "HINGE_ISA=baseline". Returns
/// the standard output and the exit status.
inline Said run_biocd(const std::string& arguments, const std::string& environment = "") {
  return run_tool(HINGE_BIOCD, arguments, environment);
}

}  // namespace hinge::test
