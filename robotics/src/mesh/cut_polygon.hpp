// SPDX-License-Identifier: BSD-3-Clause
// cut_polygon: a polygon as triangles between its own vertices.
#pragma once

#include <span>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::robotics {

/// n - 2 triangles for n >= 3 vertices, convex or not, that together are the polygon where it is flat and does not
/// cross itself, as seen along its mean normal. One or two vertices make one degenerate triangle.
std::vector<Triangle> cut_polygon(std::span<const Vec3> polygon);

}  // namespace hinge::robotics
