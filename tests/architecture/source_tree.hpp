// SPDX-License-Identifier: BSD-3-Clause
// The repository's sources for the architecture tests: path, lines, and includes of each file.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace architecture {

/// Path from the root of the repository, with '/', to the lines of the file. Tests also plant files that do not exist.
using SourceTree = std::map<std::string, std::vector<std::string>>;

/// An #include as written: the name, and whether it is in quotes.
struct Include {
  std::string name;
  bool quoted = false;
};

/// Returns all files with these extensions in the folders, read recursively; missing folders are ignored.
inline SourceTree read_sources(const std::filesystem::path& root, const std::vector<std::string>& folders,
                               const std::set<std::string>& extensions = {".hpp", ".cpp"}) {
  namespace fs = std::filesystem;
  SourceTree tree;
  for (const std::string& folder : folders) {
    if (!fs::exists(root / folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (!entry.is_regular_file() || !extensions.contains(extension)) continue;
      std::ifstream in(entry.path());
      std::vector<std::string>& lines = tree[fs::relative(entry.path(), root).generic_string()];
      for (std::string line; std::getline(in, line);) lines.push_back(line);
    }
  }
  return tree;
}

/// Returns the #include lines among these lines.
inline std::vector<Include> includes(const std::vector<std::string>& lines) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
  std::vector<Include> found;
  for (const std::string& line : lines) {
    if (std::smatch match; std::regex_search(line, match, pattern)) found.push_back({match[2], match[1] == "\""});
  }
  return found;
}

inline bool starts_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
  for (const std::string& prefix : prefixes) {
    if (text.starts_with(prefix)) return true;
  }
  return false;
}

}  // namespace architecture
