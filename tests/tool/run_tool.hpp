// SPDX-License-Identifier: BSD-3-Clause
// Runs a command-line tool as a user does, and captures its output.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <string>

namespace hinge::test {

struct Said {
  int status = -1;  ///< exit status; -1: ended by a signal
  std::string out;  ///< standard output; also standard error if the arguments contain `2>&1`
};

/// Runs a command of the shell.
inline Said run_shell(const std::string& command) {
  Said said;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return said;
  std::array<char, 4096> chunk{};
  for (std::size_t got = 0; (got = fread(chunk.data(), 1, chunk.size(), pipe)) > 0;) said.out.append(chunk.data(), got);
  const int status = pclose(pipe);
  said.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return said;
}

/// Runs the program in a shell. environment: assignments such as "HINGE_ISA=avx2", or nothing.
inline Said run_tool(const std::string& program, const std::string& arguments, const std::string& environment = "") {
  return run_shell(environment + " '" + program + "' " + arguments);
}

}  // namespace hinge::test
