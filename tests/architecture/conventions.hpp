// SPDX-License-Identifier: BSD-3-Clause
// House rules of every source file: length, first lines, names, macros, and where code may depend on the CPU.
#pragma once

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "architecture/source_tree.hpp"

namespace architecture {

/// Largest number of lines: a longer file does more than one job and should be split.
inline constexpr std::size_t longest_file = 300;

/// Returns one sentence per violation in files of the library and its modules.
inline std::vector<std::string> convention_violations(const SourceTree& tree) {
  static const std::regex isa(R"re(^\s*#.*(__AVX|__SSE|__FMA__|__ARM_NEON|__BMI|intrin\.h))re");
  static const std::regex macro(R"re(^\s*#\s*define\s+(\w+))re");
  static const std::regex open_namespace(R"re(^\s*using\s+namespace\b)re");
  static const std::regex virtual_member(R"re(^[^/"]*\bvirtual\b)re");
  static const std::regex vague(R"re((^|[/_.])(utils?|common|helpers?|misc)([/_.]|$))re");
  std::vector<std::string> violations;
  for (const auto& [path, lines] : tree) {
    const auto report = [&violations, &path = path](const std::string& what) {
      violations.push_back(path + ": " + what);
    };
    const bool is_header = path.ends_with(".hpp");
    const bool is_simd = path.starts_with("include/hinge/detail/simd/");
    if (std::regex_search(path, vague)) report("names nothing: what verb or noun lives there?");
    if (lines.size() > longest_file) report("has " + std::to_string(lines.size()) + " lines, more than 300");
    if (lines.empty() || lines[0] != "// SPDX-License-Identifier: BSD-3-Clause")
      report("does not open with the SPDX line");
    if (lines.size() < 2 || !lines[1].starts_with("// ")) report("line 2 does not say what lives in the file");
    bool once = false;
    for (const std::string& line : lines) {
      std::smatch match;
      once = once || line == "#pragma once";
      if (!is_simd && std::regex_search(line, isa)) report("knows a CPU outside simd: " + line);
      if (is_header && std::regex_search(line, open_namespace)) report("opens a namespace for everybody: " + line);
      if (std::regex_search(line, virtual_member)) report("virtual, where a template parameter would do: " + line);
      if (std::regex_search(line, match, macro) && match[1] != "HINGE_ASSERT" && match[1] != "HINGE_API" &&
          match[1] != "HINGE_REGISTERS_ABI")
        report("defines a macro: " + line);
    }
    if (is_header && !once) report("lacks #pragma once");
  }
  return violations;
}

/// Returns the concepts of the library without a non-model "!Concept<...>" in tests/static.
inline std::vector<std::string> untested_concepts(const SourceTree& library, const SourceTree& tests) {
  static const std::regex concept_name(R"re(^\s*concept\s+(\w+))re");
  std::string text;
  for (const auto& [path, lines] : tests)
    for (const std::string& line : lines) text += line + "\n";
  std::vector<std::string> untested;
  for (const auto& [path, lines] : library)
    for (const std::string& line : lines)
      if (std::smatch match; std::regex_search(line, match, concept_name))
        if (const std::string name = match[1].str() + "<";
            text.find("!" + name) == std::string::npos && text.find("!detail::" + name) == std::string::npos)
          untested.push_back(path + ": concept " + match[1].str() + " has no non-model in tests/static");
  return untested;
}

/// Returns includes of oracle libraries outside the folders that may use them.
inline std::vector<std::string> oracle_violations(const SourceTree& tree) {
  std::vector<std::string> violations;
  for (const auto& [path, lines] : tree) {
    if (starts_with_any(path, {"tests/oracle/", "bench/peers/"})) continue;
    for (const Include& include : includes(lines)) {
      if (!include.quoted && starts_with_any(include.name, {"fcl/", "ccd/", "CGAL/", "octomap/"})) {
        violations.push_back(path + " includes <" + include.name + ">, an oracle");
      }
    }
  }
  return violations;
}

/// Returns unexpected names in the root folder of the repository. Dot files and the build folder are allowed.
inline std::vector<std::string> strangers_at_top(const std::filesystem::path& root) {
  static const std::set<std::string> known = {"CMakeLists.txt",  "CMakePresets.json",
                                              "README.md",       "CHANGELOG.md",
                                              "CONTRIBUTING.md", "CITATION.cff",
                                              "LICENSE",         "run",
                                              "include",         "molecular",
                                              "robotics",        "python",
                                              "report",          "tests",
                                              "bench",           "docs",
                                              "debian",          "build"};
  std::vector<std::string> strangers;
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(root)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(".") && !known.contains(name)) strangers.push_back(name);
  }
  return strangers;
}

}  // namespace architecture
