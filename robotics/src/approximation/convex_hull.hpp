// SPDX-License-Identifier: BSD-3-Clause
// The convex hull of points, a little too large so that it surely encloses them.
#pragma once

#include <span>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::robotics {

/// Every point is at least this deep inside what encloses it: far above the rounding of a placement in the world (about
/// 10^-15 of the coordinates, so robots may reach 10^4 m), far below what meshes of links are made to.
inline constexpr double enclosing_margin = 1e-10;  // m

/// No point of the hull's surface is farther than this from the true hull (for points within 10 m of the origin).
inline constexpr double most_hull_excess = 1e-5;  // m

/// Closed, turned outward. Each point is strictly on the inner side of each triangle's plane, decided exactly, so that
/// the hull holds whatever convex combination of the points; this holds for flat, straight and single points, too,
/// around which it has a thickness of at most 10^-5 m. Points: at least one, finite. ModelError: coordinates so large
/// (beyond some 10^4 m) or so unequal that no such hull was found.
std::vector<Triangle> convex_hull(std::span<const Vec3> points);

/// Those that span the hull, up to rounding, each once; all (each once) when they are flat.
std::vector<Vec3> extreme_points(std::span<const Vec3> points);

}  // namespace hinge::robotics
