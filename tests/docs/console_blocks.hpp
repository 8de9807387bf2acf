// SPDX-License-Identifier: BSD-3-Clause
// Reads console blocks of Markdown pages: commands and their output.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hinge::test {

/// One command of a block that starts with ```console. A command is a line that starts with "$ ", with the following
/// lines as long as it ends with a backslash.
struct ConsoleCommand {
  std::size_t line = 0;          ///< line of the command in the page, from 1
  std::string command;           ///< for a shell, without "$ "
  std::size_t first_output = 0;  ///< index of the first line of output in the page's lines, from 0
  std::vector<std::string> output;
};

inline std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.emplace_back(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
  return lines;
}

/// Returns the commands of all console blocks of a page.
inline std::vector<ConsoleCommand> console_commands(const std::vector<std::string>& page) {
  std::vector<ConsoleCommand> commands;
  bool inside = false, continued = false;
  for (std::size_t i = 0; i < page.size(); ++i) {
    const std::string& line = page[i];
    if (line.starts_with("```")) {
      inside = line == "```console";
      continued = false;
      continue;
    }
    if (!inside) continue;
    if (continued) {
      commands.back().command += "\n" + line;
    } else if (line.starts_with("$ ")) {
      commands.push_back({i + 1, line.substr(2), 0, {}});
    } else if (!commands.empty()) {
      commands.back().output.push_back(line);
      continue;
    }
    continued = line.ends_with('\\');
    if (!commands.empty()) commands.back().first_output = i + 1;
  }
  return commands;
}

/// Does `actual` match the line `expected`? "..." matches any text, including none.
inline bool line_matches(std::string_view expected, std::string_view actual) {
  const std::size_t gap = expected.find("...");
  if (gap == std::string_view::npos) return expected == actual;
  if (!actual.starts_with(expected.substr(0, gap))) return false;
  const std::string_view rest = expected.substr(gap + 3);
  for (std::size_t from = gap; from <= actual.size(); ++from)
    if (line_matches(rest, actual.substr(from))) return true;
  return false;
}

/// Compares whole outputs from the given lines on. A line "..." matches any number of lines.
inline bool output_matches(const std::vector<std::string>& expected, const std::vector<std::string>& actual,
                           std::size_t e = 0, std::size_t a = 0) {
  for (; e < expected.size(); ++e, ++a) {
    if (expected[e] == "...") {
      for (std::size_t from = a; from <= actual.size(); ++from)
        if (output_matches(expected, actual, e + 1, from)) return true;
      return false;
    }
    if (a >= actual.size() || !line_matches(expected[e], actual[a])) return false;
  }
  return a == actual.size();
}

}  // namespace hinge::test
