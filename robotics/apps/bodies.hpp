// SPDX-License-Identifier: BSD-3-Clause
// Bodies around the robot, as --env describes them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/robotics/shape.hpp"

namespace robocd {

/// A mesh file or a primitive, and where it stands in the world.
struct Body {
  std::string name;
  bool is_named = false;         // by the user; else the name is the text given
  std::filesystem::path file{};  // of a mesh; empty: a primitive
  std::optional<hinge::robotics::Shape> primitive{};
  hinge::Pose pose{};
  hinge::Vec3 scale = hinge::Vec3::Ones();  // of a mesh
};

/// "[NAME=]SHAPE[,xyz=X Y Z][,rpy=R P Y][,scale=S]", with SHAPE a mesh file, "box:X Y Z", "sphere:R", "cylinder:R L" or
/// "capsule:R L"; numbers as in URDF, m and rad. The whole text may also be the name of a file that exists. ModelError,
/// naming the option: a text that does not fit.
Body parse_body(const std::string& text);

/// `notes` gets what read_mesh() says. LoadError: what it refuses.
hinge::robotics::Shape shape_of(const Body& body, std::vector<std::string>& notes);

}  // namespace robocd
