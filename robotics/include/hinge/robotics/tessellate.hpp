// SPDX-License-Identifier: BSD-3-Clause
// tessellate: converts shapes to triangles, exactly or with a bounded error on the safe side.
#pragma once

#include <cstdint>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/shape.hpp"

namespace hinge::robotics {

/// How shapes become triangles. Boxes and meshes are exact in every manner.
struct Tessellation {
  /// The three ways to approximate.
  enum class Manner : std::uint8_t {
    /// Spheres and capsules are exact: a point or a segment with a radius. Cylinders are circumscribed.
    rounded,
    /// Triangles without radius. The surface encloses the shape (up to rounding) and is at most `tolerance` away from
    /// it, so no contact is missed.
    circumscribed,
    /// Triangles without radius and with vertices on the shape: 32 sides per cylinder, 320 triangles per sphere, as in
    /// the published reference data. A capsule is a sphere of this kind, split and extended along z.
    inscribed
  };
  Manner manner = Manner::rounded;  ///< how to approximate
  double tolerance = 1e-3;          ///< m, finite, > 0; 1 mm is about the accuracy of link meshes
};

/// A surface: all points within `radius` of the triangles. Triangles of spheres and capsules are degenerate; with their
/// radius they are solid.
struct Surface {
  std::vector<Triangle> triangles;  ///< m, in the shape's frame
  double radius = 0.0;              ///< m
};

/// Returns a shape's surface in its own frame, with the mesh scale applied. A size of 0 gives a point or a segment (one
/// triangle without area) or a flat solid (each triangle once). Throws ModelError if a size is negative, a scale is 0,
/// the tolerance is not above 0, any of them is not finite, or the tolerance needs more than 10^6 triangles.
HINGE_API Surface tessellate(const Shape& shape, const Tessellation& tessellation = {});

/// Returns triangles on the surface of a shape at a pose, for pictures: manner `inscribed`. Throws as tessellate().
HINGE_API std::vector<Triangle> drawn_triangles(const Shape& shape, const Pose& pose = {});

}  // namespace hinge::robotics
