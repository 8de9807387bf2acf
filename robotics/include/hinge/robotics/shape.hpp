// SPDX-License-Identifier: BSD-3-Clause
// Shapes of links as in URDF: lengths in m, centred on their own frame; cylinders and capsules are aligned with z.
// Boxes, spheres, cylinders, capsules and the spheres of a point cloud are solid: a link inside one collides. Sizes are
// >= 0: a sphere of radius 0 is a point, a box with one size of 0 is flat.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <variant>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::robotics {

/// A solid box.
struct BoxShape {
  Vec3 size = Vec3::Ones();  ///< edge lengths along x, y, z, m
};

/// A solid sphere.
struct SphereShape {
  double radius = 1.0;  ///< m
};

/// A solid cylinder.
struct CylinderShape {
  double radius = 1.0;  ///< m
  double length = 1.0;  ///< m, along z
};

/// A solid capsule: all points within `radius` of a segment.
struct CapsuleShape {
  double radius = 1.0;  ///< m
  double length = 1.0;  ///< m, length of the segment along z; the capsule is length + 2 radius long
};

/// Solid spheres of one radius, such as the points of a depth camera with their uncertainty.
struct PointCloudShape {
  std::shared_ptr<const std::vector<Vec3>> points;  ///< m, at least one; may be shared by several bodies
  double radius = 0.0;                              ///< m
};

/// Triangles of a surface, which may be open or closed.
struct TriangleMesh {
  std::vector<Triangle> triangles;  ///< m
};

/// A mesh in a link or body.
struct MeshShape {
  std::shared_ptr<const TriangleMesh> mesh;  ///< may be shared by several links
  Vec3 scale = Vec3::Ones();                 ///< factor per axis; negative values mirror; must not be 0
  std::filesystem::path file{};              ///< source file; empty if made in code
  /// True: the inside of the mesh collides, as in a box. The mesh must then be closed, see open_edge() in
  /// containment.hpp.
  bool solid = false;
};

/// The shapes that a link or body can have.
using Shape = std::variant<BoxShape, SphereShape, CylinderShape, CapsuleShape, MeshShape, PointCloudShape>;

}  // namespace hinge::robotics
