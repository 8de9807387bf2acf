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
  std::optional<CapsuleShape> capsule{};  ///< when its shape is one; urdfdom, which knows none, is told of a sphere
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

/// In the file's order. Origins are computed here, so that they are the same bits on every CPU: urdfdom goes through
/// the sine and cosine of the C library.
struct UrdfOutline {
  std::vector<OutlinedLink> links;
  std::vector<OutlinedJoint> joints;
  std::string
      geometry_only;  ///< the file without visuals, inertias and extensions, whose faults are no concern of ours
};

/// LoadError: see XmlFile; elements without name, numbers in an origin that are not six finite ones, sizes of a capsule
/// that are not one number, a <geometry> of several shapes (urdfdom takes the first).
UrdfOutline outline_urdf(const std::filesystem::path& path);

}  // namespace hinge::robotics
