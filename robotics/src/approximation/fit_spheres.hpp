// SPDX-License-Identifier: BSD-3-Clause
// fit_spheres: covers a surface by few spheres.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/robot_description.hpp"

namespace hinge::robotics {

/// Returns at most `most` (>= 1) spheres around patches of about equal size. Every triangle is divided into pieces, and
/// each piece is inside one sphere by at least enclosing_margin. The spheres extend into the link, to protrude little
/// from it. triangles: at least one, finite, m; degenerate ones are allowed. Throws ModelError as convex_hull() does.
std::vector<PlacedShape> fit_spheres(std::span<const Triangle> triangles, std::size_t most);

}  // namespace hinge::robotics
