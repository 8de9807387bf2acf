// SPDX-License-Identifier: BSD-3-Clause
// How a command-line tool ends: exit statuses, and errors as one line on standard error.
#pragma once

#include <cstdio>
#include <exception>

#include "hinge/core/error.hpp"

namespace hinge::tool {

/// As grep's: documented in docs/reference, the same for every tool.
enum class Exit : int { free = 0, collision = 1, usage = 2, bad_input = 3, undecided = 4 };

/// Runs run() -> Exit and turns what it throws into a line and a status. ModelError is a rule or selection that does
/// not fit: the command line is at fault; every other error is the input's.
template <class Run>
int run_tool(const char* name, const Run& run) {
  const auto refuse = [name](const std::exception& error, Exit status) {
    std::fflush(stdout);
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return static_cast<int>(status);
  };
  try {
    const Exit status = run();
    // A full disk shows only now.
    if (std::fflush(stdout) != 0) throw LoadError("standard output: cannot be written");
    return static_cast<int>(status);
  } catch (const ModelError& error) {
    return refuse(error, Exit::usage);
  } catch (const std::exception& error) {
    return refuse(error, Exit::bad_input);
  }
}

}  // namespace hinge::tool
