// SPDX-License-Identifier: BSD-3-Clause
// RobotDescription: what a URDF file says of links and joints, as plain structs to read or to fill in by hand.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/robotics/shape.hpp"

namespace hinge::robotics {

/// A continuous joint is a revolute one without limits.
enum class JointType : std::uint8_t { fixed, revolute, continuous, prismatic };

/// The joint follows another one: its value is multiplier * value of `joint` + offset (rad or m).
struct Mimic {
  std::string joint;
  double multiplier = 1.0;
  double offset = 0.0;
};

struct PlacedShape {
  Shape shape;
  Pose origin{};  ///< of the shape's frame in the link's frame, m
};

struct LinkDescription {
  std::string name;
  std::vector<PlacedShape> geometry{};  ///< collision geometry
  int line = 0;                         ///< in the file it was read from; 0: made in code
};

/// The child's frame is at origin * motion(q) in the parent's frame.
struct JointDescription {
  std::string name;
  JointType type = JointType::fixed;
  std::string parent;  ///< link
  std::string child;   ///< link
  Pose origin{};
  Vec3 axis = Vec3::UnitX();  ///< any length but zero, child frame; of no matter to fixed joints
  double lower = 0.0;         ///< rad or m; of no matter to fixed and continuous joints
  double upper = 0.0;
  std::optional<Mimic> mimic{};  ///< of no matter to fixed joints
  int line = 0;                  ///< in the file it was read from; 0: made in code
};

/// Links and joints make one tree, in any order; its root link is fixed in the world.
struct RobotDescription {
  std::string name;
  std::vector<LinkDescription> links;
  std::vector<JointDescription> joints;
  std::vector<std::string> notes{};       ///< what reading left out or had to interpret, one sentence each
  std::vector<std::string> incomplete{};  ///< links that lack geometry: see UrdfOptions::skip_missing_meshes
  std::string floating_base{};            ///< the floating or planar joint that was taken as fixed; empty: none
};

}  // namespace hinge::robotics
