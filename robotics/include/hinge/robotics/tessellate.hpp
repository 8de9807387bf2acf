// SPDX-License-Identifier: BSD-3-Clause
// tessellate: triangles for boxes, spheres and cylinders, with an error that is stated and on the safe side.
#pragma once

#include <cstdint>
#include <vector>

#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/shape.hpp"

namespace hinge::robotics {

/// Boxes and meshes are exact in either manner.
struct Tessellation {
  enum class Manner : std::uint8_t {
    /// The surface encloses the shape (up to rounding) and is nowhere farther than `tolerance` from it: a contact is
    /// never missed.
    circumscribed,
    /// Vertices on the shape, 32 sides a cylinder, 320 triangles a sphere: the manner of the published reference data.
    inscribed
  };
  Manner manner = Manner::circumscribed;
  double tolerance = 1e-3;  ///< m, finite, > 0; 1 mm is what meshes of robot links are about as good as
};

/// The surface of a shape in its own frame, mesh scale applied. ModelError: sizes, scale or tolerance that are not
/// finite or not above 0 (scale: are 0), or a tolerance so small that it would take more than 10^6 triangles.
std::vector<Triangle> tessellate(const Shape& shape, const Tessellation& tessellation = {});

}  // namespace hinge::robotics
