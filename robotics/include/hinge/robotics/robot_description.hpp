// SPDX-License-Identifier: BSD-3-Clause
// RobotDescription: links and joints of a robot as plain structs, filled by the URDF reader or in code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/robotics/shape.hpp"

namespace hinge::robotics {

/// A continuous joint is a revolute joint without limits.
enum class JointType : std::uint8_t { fixed, revolute, continuous, prismatic };

/// Makes a joint follow another one: its value is multiplier * value of `joint` + offset (rad or m).
struct Mimic {
  std::string joint;        ///< name of the joint that is followed
  double multiplier = 1.0;  ///< rad or m, per rad or m
  double offset = 0.0;      ///< rad or m
};

/// A shape and its pose in a link.
struct PlacedShape {
  Shape shape;    ///< in its own frame
  Pose origin{};  ///< pose of the shape's frame in the link's frame, m
};

/// A link with its collision geometry.
struct LinkDescription {
  std::string name;                     ///< unique among links, not empty
  std::vector<PlacedShape> geometry{};  ///< collision shapes; empty: the link is not tested
  int line = 0;                         ///< line in the source file; 0: made in code
};

/// A joint. The pose of the child's frame in the parent's frame is origin * motion(q).
struct JointDescription {
  std::string name;                   ///< unique among joints, not empty
  JointType type = JointType::fixed;  ///< the motion
  std::string parent;                 ///< name of the parent link
  std::string child;                  ///< name of the child link
  Pose origin{};                      ///< in the parent's frame, m
  Vec3 axis = Vec3::UnitX();          ///< in the child's frame, any length except 0; ignored for fixed joints
  double lower = 0.0;                 ///< limits, rad or m; ignored for fixed and continuous joints
  double upper = 0.0;                 ///< rad or m, >= lower unless the joint mimics another one
  std::optional<Mimic> mimic{};       ///< ignored for fixed joints
  int line = 0;                       ///< line in the source file; 0: made in code
};

/// A robot. Links and joints, in any order, form one tree; its root link is fixed to the world.
struct RobotDescription {
  std::string name;                       ///< may be empty
  std::vector<LinkDescription> links;     ///< in any order
  std::vector<JointDescription> joints;   ///< in any order
  std::vector<std::string> notes{};       ///< one sentence for each element that the reader skipped or interpreted
  std::vector<std::string> incomplete{};  ///< links without some geometry, see UrdfOptions::skip_missing_meshes
  std::string floating_base{};            ///< floating or planar joint that was treated as fixed; empty: none
};

}  // namespace hinge::robotics
