// SPDX-License-Identifier: BSD-3-Clause
// add_exit_zero: the option --exit-zero, and what exit statuses mean.
#pragma once

#include "hinge_tools/help_texts.hpp"
#include "hinge_tools/run_tool.hpp"

namespace hinge::tool {

/// Adds --exit-zero to a CLI11 command.
template <class Command>
void add_exit_zero(Command& command, bool& value) {
  command.add_flag("--exit-zero", value,
                   "exit with status 0 whatever the verdict; errors keep 2 and 3 (for workflow managers)");
}

/// Returns the exit status of a command that ended with `status`. exit_zero: the value of --exit-zero.
inline Exit final_status(Exit status, bool exit_zero) {
  const bool is_verdict = status == Exit::collision || status == Exit::undecided || status == Exit::shortfall;
  return exit_zero && is_verdict ? Exit::free : status;
}

/// Returns the help topic about exit statuses.
inline Topic exit_status_topic() {
  return {"Exit status",
          {"  0  free, or nothing to decide", "  1  a collision was found (0 with --exit-zero)", "  2  wrong usage",
           "  3  bad input", "  4  undecided: path proved neither (0 with --exit-zero)",
           "  5  not found: conformations are missing, or a motion (0 with --exit-zero)"}};
}

}  // namespace hinge::tool
