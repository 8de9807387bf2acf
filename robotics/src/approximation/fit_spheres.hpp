// SPDX-License-Identifier: BSD-3-Clause
// Few spheres that together hold a surface.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/robot_description.hpp"

namespace hinge::robotics {

/// At most `most` spheres (>= 1) around patches of about equal size. Every triangle is cut into pieces, each of which
/// lies wholly inside one sphere, by enclosing_margin at least. The spheres reach into the link, so that they stand out
/// of it little. Triangles: at least one, finite, m; degenerate ones are held, too. ModelError: see convex_hull.
std::vector<PlacedShape> fit_spheres(std::span<const Triangle> triangles, std::size_t most);

}  // namespace hinge::robotics
