// SPDX-License-Identifier: BSD-3-Clause
// Closeness: distance, gap and closest points of one pair of triangles, always consistent with the verdict.
#pragma once

#include <cstddef>

#include "hinge/core/id.hpp"
#include "hinge/core/radius_sum.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::robotics {

/// Fields as in ClosestLinks; m, in the frame of the triangles.
struct Closeness {
  bool collides = false;  ///< true if the pair is a hit
  double distance = 0.0;
  double gap = 0.0;
  Vec3 point1 = Vec3::Zero();
  Vec3 point2 = Vec3::Zero();
};

/// Measures two placed triangles, inflated by the radii of `sum` (m), with its clearance.
Closeness closeness(const Triangle& first, const Triangle& second, const RadiusSum& sum);

/// Returns a placed triangle with the coordinates that the engine uses. Hierarchy::placed() would place all triangles.
template <class H>
Triangle triangle_at(H& hierarchy, PrimitiveId i) {
  const auto& model = hierarchy.model();
  const Triangle& local = model.primitives()[index(i)];
  const GroupId group = model.group_of(i);
  if (group == GroupId{}) return local;
  // The topmost link of a group defines the group's frame.
  std::size_t top = 0;
  while (model.groups()->group_of(id<LinkId>(top)) != group) ++top;
  return local.placed(hierarchy.link_pose(id<LinkId>(top)));
}

}  // namespace hinge::robotics
