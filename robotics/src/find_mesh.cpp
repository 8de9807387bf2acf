// SPDX-License-Identifier: BSD-3-Clause
// Relative paths, file:// and package://.
#include "find_mesh.hpp"

#include <cstdlib>
#include <string_view>
#include <system_error>

#include "hinge/core/error.hpp"

namespace hinge::robotics {

namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

fs::path find_in_packages(const std::string& name, std::string_view rest, const UrdfOptions& options) {
  const std::size_t slash = rest.find('/');
  const std::string_view package = rest.substr(0, slash);
  if (slash == std::string_view::npos || package.empty())
    throw LoadError("mesh '" + name + "': expected package://NAME/PATH");
  const fs::path inside = rest.substr(slash + 1);
  std::string looked;
  for (const fs::path& folder : options.package_folders) {
    if (is_file(folder / package / inside)) return folder / package / inside;
    // A trailing slash leaves an empty file name.
    const fs::path last = folder.has_filename() ? folder.filename() : folder.parent_path().filename();
    if (last == package && is_file(folder / inside)) return folder / inside;
    looked += (looked.empty() ? "" : ", ") + folder.string();
  }
  throw LoadError("mesh '" + name + "': not found in " +
                  (looked.empty() ? "any package folder, none was given" : "the package folders " + looked));
}

}  // namespace

fs::path find_mesh(const std::string& name, const fs::path& folder, const UrdfOptions& options) {
  constexpr std::string_view package = "package://", file = "file://";
  const std::string_view view = name;
  if (view.starts_with(package)) return find_in_packages(name, view.substr(package.size()), options);
  const std::string_view rest = view.starts_with(file) ? view.substr(file.size()) : view;
  if (rest.empty() || rest.find("://") != std::string_view::npos)
    throw LoadError("mesh '" + name + "': expected a path, file:// or package://");
  fs::path found = folder / rest;  // an absolute path stays itself
  if (!is_file(found)) throw LoadError("mesh '" + name + "': there is no file " + found.string());
  return found;
}

std::vector<fs::path> ros_package_path() {
  std::vector<fs::path> folders;
  const char* value = std::getenv("ROS_PACKAGE_PATH");
  std::string_view rest = value != nullptr ? value : "";
  while (!rest.empty()) {
    const std::string_view folder = rest.substr(0, rest.find(':'));
    if (!folder.empty()) folders.emplace_back(folder);
    rest.remove_prefix(folder.size() < rest.size() ? folder.size() + 1 : rest.size());
  }
  return folders;
}

}  // namespace hinge::robotics
