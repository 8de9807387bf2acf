// SPDX-License-Identifier: BSD-3-Clause
// read_urdf: a robot's description and its meshes from a URDF file.
#pragma once

#include <filesystem>
#include <vector>

#include "hinge/robotics/robot_description.hpp"

namespace hinge::robotics {

struct UrdfOptions {
  /// Folders that hold packages, or are one: package://NAME/REST is FOLDER/NAME/REST, or FOLDER/REST when the folder is
  /// called NAME. The first that has the file counts. Then come the package that the URDF file lies in (a folder above
  /// it with a package.xml) and its neighbours.
  std::vector<std::filesystem::path> package_folders{};
  /// Leave out geometry whose mesh is absent, has no triangles or is of a format that is not read, and shapes that are
  /// not read. The links are listed in RobotDescription::incomplete, with a note each.
  bool skip_missing_meshes = false;
};

/// Of the environment, for whoever wants them in UrdfOptions: the folders in ROS_PACKAGE_PATH, then the folder `share`
/// of each one in AMENT_PREFIX_PATH.
std::vector<std::filesystem::path> ros_package_path();

/// Links, joints and collision geometry (m, rad) in the file's order; visuals, inertias and extensions are not looked
/// at, but for <capsule radius length> (its length without the caps). Mesh paths are relative to the URDF file,
/// absolute, file:// or package://. A floating or planar joint that carries all the geometry is taken as fixed. What
/// cannot change a verdict is no error; where it may surprise, a note says so.
/// LoadError, one line naming file, line and element: bad XML, input for xacro, unknown or repeated names, links that
/// make no tree, other floating and planar joints, axes and scales of zero, sizes below 0, numbers that are not finite,
/// shapes that are not read, meshes that are missing (unless skipped) or bad.
RobotDescription read_urdf(const std::filesystem::path& path, const UrdfOptions& options = {});

}  // namespace hinge::robotics
