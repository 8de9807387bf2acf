// SPDX-License-Identifier: BSD-3-Clause
// FCL's two triangle kernels, which its meshes' collide and distance call, and its meshes of one triangle each.
#pragma once

#include <array>

namespace hinge::bench {

/// The coordinates of three corners.
using FclCorners = std::array<double, 9>;

/// Whether the triangles share a point, by Intersect<double>::intersect_Triangle.
bool fcl_intersect(const FclCorners& p, const FclCorners& q);
/// Distance of the triangles, by TriangleDistance<double>::triDistance.
double fcl_distance(const FclCorners& p, const FclCorners& q);

/// The same by fcl::collide and fcl::distance on two BVHModel<OBBRSS<double>> of one triangle each.
bool fcl_meshes_collide(const FclCorners& p, const FclCorners& q);
double fcl_meshes_distance(const FclCorners& p, const FclCorners& q);

/// Whether two balls touch, by fcl::collide.
bool fcl_balls_collide(const std::array<double, 3>& p, double p_radius, const std::array<double, 3>& q,
                       double q_radius);

}  // namespace hinge::bench
