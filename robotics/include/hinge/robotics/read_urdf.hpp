// SPDX-License-Identifier: BSD-3-Clause
// read_urdf: a robot's description and its meshes from a URDF file.
#pragma once

#include <filesystem>
#include <vector>

#include "hinge/robotics/robot_description.hpp"

namespace hinge::robotics {

struct UrdfOptions {
  /// Folders that hold packages, or are one: package://NAME/REST is FOLDER/NAME/REST, or FOLDER/REST when the folder is
  /// called NAME. The first that exists counts.
  std::vector<std::filesystem::path> package_folders{};
};

/// The folders in the environment variable ROS_PACKAGE_PATH, for whoever wants them in UrdfOptions.
std::vector<std::filesystem::path> ros_package_path();

/// Links, joints and collision geometry (m, rad) in the file's order; visuals, inertias and extensions are not looked
/// at, but for <capsule radius length> (its length without the caps). Mesh paths are relative to the URDF file,
/// absolute, file:// or package://. LoadError, one line naming file, line and element: bad XML, xacro input, unknown or
/// repeated names, links that make no tree, floating and planar joints, zero axes, sizes and scales, numbers that are
/// not finite, meshes that are missing or bad.
RobotDescription read_urdf(const std::filesystem::path& path, const UrdfOptions& options = {});

}  // namespace hinge::robotics
