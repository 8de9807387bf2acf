// SPDX-License-Identifier: BSD-3-Clause
// Shapes of links as URDF knows them, in metres, centred on their own frame; cylinders and capsules stand along z.
// Boxes, spheres, cylinders and capsules are solid: what lies inside them collides.
// Sizes are 0 or above: a sphere of radius 0 is a point, a box with one side of 0 is flat.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <variant>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::robotics {

struct BoxShape {
  Vec3 size = Vec3::Ones();  ///< edge lengths
};

struct SphereShape {
  double radius = 1.0;
};

struct CylinderShape {
  double radius = 1.0;
  double length = 1.0;
};

/// What is at most `radius` away from a segment.
struct CapsuleShape {
  double radius = 1.0;
  double length = 1.0;  ///< of the segment: from end to end it is length + 2 radius
};

/// A surface; closed or not, nothing is assumed.
struct TriangleMesh {
  std::vector<Triangle> triangles;
};

struct MeshShape {
  std::shared_ptr<const TriangleMesh> mesh;  ///< shared by the links that use the same file
  Vec3 scale = Vec3::Ones();                 ///< factor per axis, negative ones mirror; none is 0
  std::filesystem::path file{};              ///< where it was read from; empty when made in code
  /// What lies inside collides, as in a box. The mesh has to be closed, see open_edge() in containment.hpp.
  bool solid = false;
};

using Shape = std::variant<BoxShape, SphereShape, CylinderShape, CapsuleShape, MeshShape>;

}  // namespace hinge::robotics
