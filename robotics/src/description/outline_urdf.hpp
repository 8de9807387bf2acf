// SPDX-License-Identifier: BSD-3-Clause
// outline_urdf: order, lines and origins of a URDF file, which urdfdom does not report, and a reduced text for urdfdom.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hinge/core/pose.hpp"
#include "hinge/robotics/shape.hpp"

namespace hinge::robotics {

/// A <collision> element.
struct OutlinedCollision {
  int line = 0;
  Pose origin{};
  // For these shapes urdfdom reads a sphere instead.
  std::optional<CapsuleShape> capsule{};  ///< set if the shape is a capsule
  std::string unread{};                   ///< element name of a shape of unknown type
};

/// A <link> element.
struct OutlinedLink {
  std::string name;
  int line = 0;
  std::vector<OutlinedCollision> collisions;
};

/// A <joint> element.
struct OutlinedJoint {
  std::string name;
  int line = 0;
  Pose origin{};              ///< pose of the child's frame in the parent's frame, m
  std::string parent, child;  ///< names of the links
};

/// The elements in the order of the file. Faults that change no verdict but that urdfdom rejects are repaired: efforts
/// and velocities, limits and axes of joints that do not use them, blanks around numbers. Origins are computed here, to
/// get the same bits on every CPU: urdfdom uses the sine and cosine of the C library.
struct UrdfOutline {
  std::vector<OutlinedLink> links;
  std::vector<OutlinedJoint> joints;
  std::vector<std::string> notes;
  std::string geometry_only;  ///< without visuals, inertias and extensions, whose faults do not matter here
};

/// Throws LoadError as XmlFile does, and for elements without name, an xyz or rpy that is not three finite numbers, a
/// capsule size that is not one finite number, and xacro that could stand for geometry or change it.
/// text: the bytes of the file `path`.
UrdfOutline outline_urdf(const std::filesystem::path& path, const std::string& text);

}  // namespace hinge::robotics
