// SPDX-License-Identifier: BSD-3-Clause
// read_urdf, parse_urdf: read a robot's description and its meshes from a URDF file or its text.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/robotics/robot_description.hpp"

namespace hinge::robotics {

/// Options of read_urdf().
struct UrdfOptions {
  /// Folders that contain packages or are packages themselves. package://NAME/REST is FOLDER/NAME/REST, or FOLDER/REST
  /// if the folder is called NAME; the first existing file is used. If none exists, the package around the URDF file (a
  /// parent folder with package.xml) and the packages next to it are searched.
  std::vector<std::filesystem::path> package_folders{};
  /// Skips shapes of unknown type, and meshes that are missing, have no triangles or have an unknown format. The links
  /// are listed in RobotDescription::incomplete, with one note each.
  bool skip_missing_meshes = false;
};

/// Returns package folders from the environment: those in ROS_PACKAGE_PATH, then the folder `share` of each prefix in
/// AMENT_PREFIX_PATH. read_urdf() does not call it.
HINGE_API std::vector<std::filesystem::path> ros_package_path();

/// Reads links, joints and collision geometry (m, rad), in the order of the file. Visuals, inertias and extensions are
/// ignored, except `<capsule radius length>` (length without the caps). A mesh path is relative to the URDF file,
/// absolute, file:// or package://. A floating or planar joint above all geometry is treated as fixed. A fault that
/// cannot change a verdict is not an error; a note reports it if it may surprise.
/// Throws LoadError (one line with file, line and element) for bad XML, xacro input, unknown or repeated names, links
/// that do not form a tree, other floating or planar joints, a zero axis or scale, negative sizes, numbers that are not
/// finite, shapes of unknown type, and missing (unless skipped) or bad meshes.
HINGE_API RobotDescription read_urdf(const std::filesystem::path& path, const UrdfOptions& options = {});
/// The same for the text of a URDF file that may be in memory only. path: names the text in messages; mesh paths are
/// relative to its folder.
HINGE_API RobotDescription parse_urdf(const std::string& text, const std::filesystem::path& path,
                                      const UrdfOptions& options = {});

}  // namespace hinge::robotics
