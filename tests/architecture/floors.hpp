// SPDX-License-Identifier: BSD-3-Clause
// The floor table: which folder may include which. A folder may include only itself and folders on lower floors.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "architecture/source_tree.hpp"

namespace architecture {

/// Floor of each folder or file under include/hinge and of each module. Folders on one floor may not include each
/// other; engines share code in engine/ itself. Every file may include version.hpp, which includes nothing. Folders
/// under include/hinge/detail are on the floor of their public folder. The core is below hinge_tools, which serves the
/// tools, and hinge_planning, which serves the libraries; neither is installed. The Python package is above all, and
/// knows public headers only.
inline const std::map<std::string, int>& floors() {
  static const std::map<std::string, int> table = [] {
    const std::vector<std::vector<std::string>> by_floor = {{"core"},
                                                            {"simd", "exact"},
                                                            {"bounds"},
                                                            {"policy", "kinematics"},
                                                            {"primitive"},
                                                            {"model"},
                                                            {"query"},
                                                            {"engine", "engine/brute", "engine/lazy", "engine/simd"},
                                                            {"hierarchy.hpp"},
                                                            {"path", "batch", "moves"},
                                                            {"hinge.hpp"},
                                                            {"hinge_tools", "hinge_planning"},
                                                            {"molecular", "robotics"},
                                                            {"python"}};
    std::map<std::string, int> rows = {{"version.hpp", -1}};
    for (std::size_t floor = 0; floor < by_floor.size(); ++floor) {
      for (const std::string& row : by_floor[floor]) rows[row] = static_cast<int>(floor);
    }
    return rows;
  }();
  return table;
}

/// Returns the row of the table of a file, or "" if there is none. `path` is relative to the root of the repository.
inline std::string row_of(const std::string& path) {
  for (const char* module : {"molecular", "robotics", "python"}) {
    if (path.starts_with(std::string(module) + "/")) return module;
  }
  for (const char* folder : {"hinge_tools", "hinge_planning"}) {
    if (path.starts_with(std::string("include/") + folder + "/")) return folder;
  }
  static const std::string root = "include/hinge/";
  if (!path.starts_with(root)) return "";
  std::string row = path.substr(root.size());
  if (row.starts_with("detail/")) row = row.substr(std::string("detail/").size());
  // The public header engine/x.hpp and the folder detail/engine/x are one row.
  if (row.starts_with("engine/") && row.ends_with(".hpp") && floors().contains(row.substr(0, row.size() - 4)))
    return row.substr(0, row.size() - 4);
  // A folder without its own row belongs to its parent folder.
  while (!floors().contains(row)) {
    const std::size_t slash = row.rfind('/');
    if (slash == std::string::npos) return "";
    row.resize(slash);
  }
  return row;
}

/// Returns the path of a quoted include from the root of the repository, or "" if no such file is in the tree.
inline std::string resolve(const SourceTree& tree, const std::string& from, const std::string& name) {
  std::vector<std::string> roots = {"include/", "molecular/include/", "robotics/include/"};
  for (const char* module : {"molecular/", "robotics/", "python/"}) {  // src is an include path only for its own module
    if (from.starts_with(module)) roots.push_back(std::string(module) + "src/");
  }
  for (const std::string& root : roots) {
    if (tree.contains(root + name)) return root + name;
  }
  const std::string beside = from.substr(0, from.rfind('/') + 1) + name;
  const bool is_public = from.find("include/hinge/") != std::string::npos;
  return !is_public && tree.contains(beside) ? beside : "";
}

/// Returns one sentence per include that goes to a higher floor, to another folder on the same floor, to a foreign
/// library out of place, or to no file.
inline std::vector<std::string> floor_violations(const SourceTree& tree) {
  std::vector<std::string> violations;
  for (const auto& [path, lines] : tree) {
    const std::string row = row_of(path);
    if (row.empty()) {
      violations.push_back(path + " is in a folder the floor table does not know");
      continue;
    }
    for (const Include& include : includes(lines)) {
      if (!include.quoted) {
        const bool is_core = path.starts_with("include/");
        const bool is_standard = include.name.find_first_of("/.") == std::string::npos;
        const bool is_isa = row == "simd" && include.name.ends_with("intrin.h");
        const bool is_process = row == "hinge_tools" && (include.name == "unistd.h" || include.name == "fcntl.h" ||
                                                         include.name == "sys/stat.h");
        const bool is_json = row == "hinge_tools" && include.name == "nlohmann/json.hpp";
        const bool is_command_line = row == "hinge_tools" && include.name == "CLI/CLI.hpp";
        const bool is_digest = row == "hinge_tools" && include.name == "sha2.h";
        const bool is_threads = row == "batch" && include.name.starts_with("tbb/");
        const bool is_planner = row == "hinge_planning" && include.name.starts_with("ompl/");
        if (is_core && !is_standard && !is_isa && !is_process && !is_json && !is_command_line && !is_digest &&
            !is_threads && !is_planner && !include.name.starts_with("Eigen/")) {
          violations.push_back(path + " includes <" + include.name +
                               ">: the core knows the standard library and Eigen");
        }
        continue;
      }
      const std::string target = resolve(tree, path, include.name);
      const std::string target_row = row_of(target);
      if (target_row.empty()) {
        violations.push_back(path + " includes \"" + include.name + "\", which is none of ours");
      } else if (row == "python" && target.find("/detail/") != std::string::npos) {
        violations.push_back(path + " includes " + target + ", which is private");
      } else if (target_row != row && !row.starts_with(target_row + "/") &&
                 floors().at(target_row) >= floors().at(row)) {
        violations.push_back(path + " includes " + target + ", which is not on a lower floor");
      }
    }
  }
  return violations;
}

/// Returns the files of an include cycle; empty if there is none.
inline std::vector<std::string> include_circle(const SourceTree& tree) {
  std::set<std::string> finished;
  std::vector<std::string> open;
  const auto visit = [&](const auto& self, const std::string& path) -> bool {
    if (finished.contains(path)) return false;
    for (const std::string& ancestor : open) {
      if (ancestor == path) return true;
    }
    open.push_back(path);
    for (const Include& include : includes(tree.at(path))) {
      const std::string target = include.quoted ? resolve(tree, path, include.name) : "";
      if (!target.empty() && self(self, target)) return true;
    }
    open.pop_back();
    finished.insert(path);
    return false;
  };
  for (const auto& [path, lines] : tree) {
    if (visit(visit, path)) return open;
  }
  return {};
}

}  // namespace architecture
