// SPDX-License-Identifier: BSD-3-Clause
// run_tool: exit statuses of command-line tools, and errors as one line on standard error.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "hinge/core/error.hpp"
#include "hinge_tools/standard_streams.hpp"

namespace hinge::tool {

/// Exit statuses, as grep uses them; the same for every tool, documented in docs/reference.
enum class Exit : int { free = 0, collision = 1, usage = 2, bad_input = 3, undecided = 4, shortfall = 5 };

/// Returns the text on one line: control characters are escaped as \n or \x1b.
inline std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f) {
      line += c;
      continue;
    }
    constexpr const char* digits = "0123456789abcdef";
    line += '\\';
    if (c == '\n')
      line += 'n';
    else
      line += {'x', digits[byte >> 4U], digits[byte & 15U]};
  }
  return line;
}

/// Runs run() -> Exit and returns the exit status. Exceptions become one line on standard error, after `name`.
/// ModelError means a wrong command line (status usage); all other errors are bad input. A failed write to standard
/// output is bad input too.
template <class Run>
int run_tool(const char* name, const Run& run) {
  prepare_standard_streams();
  const auto refuse = [name](const std::string& error, Exit status) {
    std::fflush(stdout);
    std::fprintf(stderr, "%s: %s\n", name, one_line(error).c_str());
    return static_cast<int>(status);
  };
  const auto refuse_output = [&](int error) {
    return refuse(std::string("standard output: cannot be written: ") + std::strerror(error != 0 ? error : EIO) +
                      "; the output is cut short",
                  Exit::bad_input);
  };
  try {
    const Exit status = run();
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) return refuse_output(errno);
    return static_cast<int>(status);
  } catch (const ModelError& error) {
    return refuse(error.what(), Exit::usage);
  } catch (const std::system_error& error) {
    return std::ferror(stdout) != 0 ? refuse_output(error.code().value()) : refuse(error.what(), Exit::bad_input);
  } catch (const std::bad_alloc&) {
    return refuse("not enough memory", Exit::bad_input);
  } catch (const std::exception& error) {
    return refuse(error.what(), Exit::bad_input);
  }
}

}  // namespace hinge::tool
