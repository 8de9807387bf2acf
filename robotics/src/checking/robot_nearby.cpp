// SPDX-License-Identifier: BSD-3-Clause
// Computes distances far from the world origin in the frame of one of the two links, to keep their accuracy.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "checking/free_in_world.hpp"
#include "hinge/core/id.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/robotics/robot_checker.hpp"

namespace hinge::robotics {

bool RobotChecker::is_far(const ClosestLinks& found) const {
  constexpr double far_away = 256.0;  // ratio of coordinates to size; the distance then has lost 8 bits
  double size = found.distance, place = 0.0;
  for (int k = 0; k < 3; ++k) {
    place = std::max({place, std::abs(found.point1[k]), std::abs(found.point2[k])});
    for (const LinkId link : {found.link1, found.link2}) {
      const Aabb& box = (*local_boxes_)[index(link)];
      size = std::max({size, std::abs(box.lower[k]), std::abs(box.upper[k])});
    }
  }
  return place > far_away * size;
}

Pose RobotChecker::place_nearby(LinkId anchor_link) {
  const KinematicTree& tree = robot_->model().tree();
  const RigidGroups groups(tree, DofSelection::all(tree));
  const auto in_parent = [&](GroupId group) {
    const RigidGroup& g = groups[group];
    return g.joint.origin * motion(g.joint, full_[g.dof]);
  };
  // Compose poses from the anchor group up to the root, then down to all other groups. Transforms above the lowest
  // common ancestor of a group and the anchor do not enter.
  const GroupId anchor = groups.group_of(anchor_link);
  std::vector<std::optional<Pose>> relative(groups.size());
  relative[index(anchor)] = Pose{};
  for (GroupId g = anchor; index(g) != 0; g = groups[g].parent)
    relative[index(groups[g].parent)] = *relative[index(g)] * in_parent(g).inverse();
  for (std::size_t g = 1; g < groups.size(); ++g)
    if (!relative[g]) relative[g] = *relative[index(groups[id<GroupId>(g)].parent)] * in_parent(id<GroupId>(g));
  std::vector<Pose> poses{Pose{}};
  for (const std::optional<Pose>& pose : relative) poses.push_back(*pose);
  if (!nearby_) nearby_ = make_hierarchy(engine_, free_in_world(robot_->model()), filter_, margins_);
  std::visit([&](auto& hierarchy) { hierarchy.update_poses(poses); }, *nearby_);
  return link_pose(anchor_link) * groups.link_in_group(anchor_link).inverse();
}

void RobotChecker::take_nearby(ClosestLinks& found, const ClosestLinks& closer, const Pose& frame) {
  // The verdict in world coordinates has priority.
  if (closer.collides() != found.collides() || (closer.distance > 0.0) != (found.distance > 0.0)) return;
  found = closer;
  found.point1 = frame * closer.point1;
  found.point2 = frame * closer.point2;
}

}  // namespace hinge::robotics
