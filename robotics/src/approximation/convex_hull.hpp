// SPDX-License-Identifier: BSD-3-Clause
// convex_hull: the convex hull of points, slightly enlarged so that it certainly encloses them.
#pragma once

#include <span>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::robotics {

/// Smallest depth of a point inside its enclosing shape. Far above the rounding of a placement in the world (about
/// 10^-15 of the coordinates, so coordinates up to 10^4 m are safe), far below the accuracy of link meshes.
inline constexpr double enclosing_margin = 1e-10;  // m

/// Largest distance of the hull's surface from the true hull, for points within 10 m of the origin.
inline constexpr double most_hull_excess = 1e-5;  // m

/// Returns a closed hull, oriented outward. Each point is strictly on the inner side of each triangle's plane (decided
/// exactly), so the hull encloses every convex combination of the points. Coplanar, collinear and single points get a
/// thickness of at most 10^-5 m. points: at least one, finite, m. Throws ModelError if coordinates are so large (above
/// about 10^4 m) or so unequal that no hull was found.
std::vector<Triangle> convex_hull(std::span<const Vec3> points);

/// Returns the points that span the hull, up to rounding, each once. If they are flat: all points, each once.
std::vector<Vec3> extreme_points(std::span<const Vec3> points);

}  // namespace hinge::robotics
