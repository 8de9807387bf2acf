// SPDX-License-Identifier: BSD-3-Clause
// What urdfdom does not tell of a URDF file: the order and the lines of its elements; and what it need not see.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hinge/core/pose.hpp"
#include "hinge/robotics/shape.hpp"

namespace hinge::robotics {

struct OutlinedCollision {
  int line = 0;
  Pose origin{};
  // urdfdom is told of a sphere in place of these.
  std::optional<CapsuleShape> capsule{};  ///< when its shape is one
  std::string unread{};                   ///< the element, when its shape is none that anyone here reads
};

struct OutlinedLink {
  std::string name;
  int line = 0;
  std::vector<OutlinedCollision> collisions;
};

struct OutlinedJoint {
  std::string name;
  int line = 0;
  Pose origin{};
  std::string parent, child;  ///< links
};

/// In the file's order. What can change no verdict and urdfdom is strict about is mended: efforts and velocities,
/// limits and axes of joints that have no use for them, blanks around numbers. Origins are computed here, so that they
/// are the same bits on every CPU: urdfdom goes through the sine and cosine of the C library.
struct UrdfOutline {
  std::vector<OutlinedLink> links;
  std::vector<OutlinedJoint> joints;
  std::vector<std::string> notes;
  std::string
      geometry_only;  ///< the file without visuals, inertias and extensions, whose faults are no concern of ours
};

/// LoadError: see XmlFile; elements without name, numbers in an origin that are not six finite ones, sizes of a capsule
/// that are not one number, xacro left where it could stand for geometry or change it.
UrdfOutline outline_urdf(const std::filesystem::path& path);

}  // namespace hinge::robotics
