// SPDX-License-Identifier: BSD-3-Clause
// Body: a body around the robot, as --env describes it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/robotics/shape.hpp"

namespace robocd {

/// A mesh file, a file of points or a primitive, and its pose in the world. Lengths in m.
struct Body {
  std::string name;
  bool is_named = false;           // true: the user gave the name; false: the name is the whole text
  std::filesystem::path file{};    // mesh or points; empty: a primitive
  std::optional<double> radius{};  // of the points in the file; empty: the file is a mesh
  std::optional<hinge::robotics::Shape> primitive{};
  hinge::Pose pose{};                       // in the world, or in the frame of `holder`
  std::optional<std::string> holder{};      // name of the link that holds it; empty: it stands in the world
  hinge::Vec3 scale = hinge::Vec3::Ones();  // of a mesh
};

/// Parses "[NAME=]SHAPE[,xyz=X Y Z][,rpy=R P Y][,scale=S]". SHAPE is a mesh file, "box:X Y Z", "sphere:R", "cylinder:R
/// L", "capsule:R L" or "points:FILE R" (a sphere of radius R at each point); numbers as in URDF, m and rad. If the
/// whole text is the path of an existing file, it is a mesh. Throws ModelError, naming the option, for any other text.
Body parse_body(const std::string& text);

/// Returns the shape, read from the mesh file if there is one. Appends the notes of read_mesh(). Throws LoadError as
/// read_mesh() and read_points().
hinge::robotics::Shape shape_of(const Body& body, std::vector<std::string>& notes);

}  // namespace robocd
