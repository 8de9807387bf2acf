// SPDX-License-Identifier: BSD-3-Clause
// check_output: checks that an output option does not name a file that must not be overwritten.
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "hinge/core/error.hpp"

namespace hinge::tool {

/// True if both are the same file: equal device and inode, under any name.
inline bool is_same_file(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/// Call this before writing to `path`. option: for messages, for example "--out". Inputs that do not exist are skipped:
/// their reader reports them. Throws ModelError if the path is a directory, one of the inputs, or the regular file that
/// standard output or standard error goes to.
inline void check_output(const std::string& option, const std::filesystem::path& path,
                         const std::vector<std::filesystem::path>& inputs) {
  struct stat output = {}, other = {};
  if (path.empty() || ::stat(path.c_str(), &output) != 0) return;
  const auto refuse = [&](const std::string& what) { throw ModelError(option + " " + path.string() + ": " + what); };
  if (S_ISDIR(output.st_mode)) refuse("is a directory, expected a file to write");
  if (!S_ISREG(output.st_mode)) return;
  for (const std::filesystem::path& input : inputs)
    if (::stat(input.c_str(), &other) == 0 && is_same_file(output, other))
      refuse("is the input " + input.string() + ", expected a different file to write");
  for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO})
    if (::fstat(descriptor, &other) == 0 && is_same_file(output, other))
      refuse(std::string("is the file of standard ") + (descriptor == STDOUT_FILENO ? "output" : "error") +
             ", expected a different file to write");
}

/// check_output() for the page of --report. out: the file of --out, or empty. Throws ModelError also if the name does
/// not end with .html, or if both options name one file.
inline void check_report(const std::filesystem::path& report, const std::filesystem::path& out,
                         const std::vector<std::filesystem::path>& inputs) {
  if (report.empty()) return;
  const std::string given = "--report " + report.string();
  if (report.extension() != ".html") throw ModelError(given + ": expected a file name with .html");
  std::error_code error;
  if (!out.empty() && std::filesystem::weakly_canonical(report, error) == std::filesystem::weakly_canonical(out, error))
    throw ModelError(given + ": is the file of --out, expected a different file");
  check_output("--report", report, inputs);
}

}  // namespace hinge::tool
