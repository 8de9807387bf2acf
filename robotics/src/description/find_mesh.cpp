// SPDX-License-Identifier: BSD-3-Clause
// Resolves mesh names: relative paths, file:// and package://, also in the package around the URDF file.
#include "description/find_mesh.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "description/missing_mesh.hpp"
#include "description/read_xml.hpp"
#include "hinge/core/error.hpp"

namespace hinge::robotics {

namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// Returns the name of the package whose package.xml is in the folder: its <name>, or the name of the folder. "": not a
/// package.
std::string package_in(const fs::path& folder) {
  if (!is_file(folder / "package.xml")) return "";
  try {
    XmlFile file(folder / "package.xml", "package");
    const tinyxml2::XMLElement* name = file.root().FirstChildElement("name");
    if (name != nullptr && name->GetText() != nullptr) return name->GetText();
  } catch (const LoadError&) {  // a bad package.xml is no error here
  }
  return folder.filename().string();
}

/// Searches the packages that contain `folder`, and the packages next to them. Returns an empty path if none has the
/// file.
fs::path find_around(const fs::path& folder, const fs::path& package, const fs::path& inside) {
  std::error_code failed;
  fs::path above = fs::absolute(folder, failed).lexically_normal();
  if (!failed && !above.has_filename()) above = above.parent_path();  // "." ends with a slash
  for (; !failed && above.has_relative_path(); above = above.parent_path()) {
    const std::string here = package_in(above);
    if (here.empty()) continue;
    if (here == package && is_file(above / inside)) return above / inside;
    if (is_file(above.parent_path() / package / inside)) return above.parent_path() / package / inside;
  }
  return {};
}

fs::path find_in_packages(const std::string& name, std::string_view rest, const fs::path& urdf_folder,
                          const UrdfOptions& options) {
  rest.remove_prefix(std::min(rest.find_first_not_of('/'), rest.size()));  // package:///NAME is common
  const std::size_t slash = rest.find('/');
  const std::string_view package = rest.substr(0, slash);
  if (slash == std::string_view::npos || package.empty())
    throw LoadError("mesh '" + name + "': expected package://NAME/PATH");
  const fs::path inside = rest.substr(slash + 1);
  std::string looked;
  for (const fs::path& folder : options.package_folders) {
    if (is_file(folder / package / inside)) return folder / package / inside;
    // A path with a trailing slash has an empty file name.
    const fs::path last = folder.has_filename() ? folder.filename() : folder.parent_path().filename();
    if (last == package && is_file(folder / inside)) return folder / inside;
    looked += (looked.empty() ? "" : ", ") + folder.string();
  }
  fs::path around = find_around(urdf_folder, package, inside);
  if (!around.empty()) return around;
  throw MissingMesh("mesh '" + name + "': not found near the URDF file" +
                    (looked.empty() ? ", and no package folder is given" : " or in the package folders " + looked) +
                    "; give the folder that holds package '" + std::string(package) + "' with --package-path");
}

/// Returns the folders in an environment variable, separated by colons.
std::vector<fs::path> listed_in(const char* variable) {
  std::vector<fs::path> folders;
  const char* value = std::getenv(variable);
  std::string_view rest = value != nullptr ? value : "";
  while (!rest.empty()) {
    const std::string_view folder = rest.substr(0, rest.find(':'));
    if (!folder.empty()) folders.emplace_back(folder);
    rest.remove_prefix(folder.size() < rest.size() ? folder.size() + 1 : rest.size());
  }
  return folders;
}

}  // namespace

fs::path find_mesh(const std::string& name, const fs::path& folder, const UrdfOptions& options) {
  constexpr std::string_view package = "package://", file = "file://";
  const std::string_view view = name;
  if (view.starts_with(package)) return find_in_packages(name, view.substr(package.size()), folder, options);
  const std::string_view rest = view.starts_with(file) ? view.substr(file.size()) : view;
  if (rest.empty() || rest.find("://") != std::string_view::npos)
    throw LoadError("mesh '" + name + "': expected a path, file:// or package://");
  fs::path found = folder / rest;  // an absolute path replaces `folder`
  std::error_code ignored;
  if (!is_file(found))
    throw MissingMesh("mesh '" + name + "': " +
                      (fs::exists(found, ignored) ? found.string() + " is not a regular file"
                                                  : "there is no file " + found.string()));
  return found;
}

std::vector<fs::path> ros_package_path() {
  std::vector<fs::path> folders = listed_in("ROS_PACKAGE_PATH");
  for (const fs::path& prefix : listed_in("AMENT_PREFIX_PATH")) folders.push_back(prefix / "share");
  return folders;
}

}  // namespace hinge::robotics
