// SPDX-License-Identifier: BSD-3-Clause
// tessellate: triangles for boxes, spheres, cylinders and capsules, exact or with a stated error on the safe side.
#pragma once

#include <cstdint>
#include <vector>

#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/shape.hpp"

namespace hinge::robotics {

/// Boxes and meshes are exact in any manner.
struct Tessellation {
  enum class Manner : std::uint8_t {
    /// Spheres and capsules are exact: a point and a segment with a radius. The rest is circumscribed.
    rounded,
    /// Triangles alone. The surface encloses the shape (up to rounding) and is nowhere farther than `tolerance` from
    /// it: a contact is never missed.
    circumscribed,
    /// Triangles alone, vertices on the shape, 32 sides a cylinder, 320 triangles a sphere: the manner of the published
    /// reference data. A capsule is such a sphere drawn apart.
    inscribed
  };
  Manner manner = Manner::rounded;
  double tolerance = 1e-3;  ///< m, finite, > 0; 1 mm is what meshes of robot links are about as good as
};

/// What is at most `radius` away from the triangles; those of spheres and capsules are degenerate, and solid then.
struct Surface {
  std::vector<Triangle> triangles;
  double radius = 0.0;  ///< m
};

/// A shape in its own frame, mesh scale applied. Sizes of 0 give a point or a segment (one triangle without area) or a
/// flat solid (no triangle twice). ModelError: sizes below 0, a scale of 0, a tolerance not above 0, any of them not
/// finite, or a tolerance so small that it would take more than 10^6 triangles.
Surface tessellate(const Shape& shape, const Tessellation& tessellation = {});

}  // namespace hinge::robotics
