// SPDX-License-Identifier: BSD-3-Clause
// cut_polygon: divides a polygon into triangles between its own vertices.
#pragma once

#include <span>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::robotics {

/// Returns n - 2 triangles for n >= 3 vertices. If the polygon is flat and does not cross itself, seen along its mean
/// normal, they cover it exactly, convex or not. One or two vertices give one degenerate triangle.
std::vector<Triangle> cut_polygon(std::span<const Vec3> polygon);

}  // namespace hinge::robotics
