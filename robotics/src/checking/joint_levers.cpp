// SPDX-License-Identifier: BSD-3-Clause
// Measures the levers of joints at random configurations.
#include "checking/joint_levers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/kinematics/kinematic_tree.hpp"

namespace hinge::robotics {

namespace {

constexpr std::uint64_t lever_samples = 32;

std::vector<Vec3> corners_of(const Aabb& box) {
  std::vector<Vec3> corners;
  if (box.is_empty()) return corners;
  for (unsigned k = 0; k < 8; ++k)
    corners.emplace_back((k & 1U) != 0 ? box.upper[0] : box.lower[0], (k & 2U) != 0 ? box.upper[1] : box.lower[1],
                         (k & 4U) != 0 ? box.upper[2] : box.lower[2]);
  return corners;
}

/// Returns the corners of the box of each link, in its frame; none for a link without geometry.
std::vector<std::vector<Vec3>> link_corners(const Robot& robot) {
  std::vector<Aabb> boxes(robot.link_count());
  for (std::size_t i = 0; i < robot.model().size(); ++i)
    boxes[index(robot.model().links()[i])].extend(robot.model().primitives()[i].bounds());
  std::vector<std::vector<Vec3>> corners;
  for (const Aabb& box : boxes) corners.push_back(corners_of(box));
  return corners;
}

/// Poses of the links in the frame of the root, and the joint axes there. values: one per DOF.
struct PlacedJoints {
  std::vector<Pose> poses;
  std::vector<Vec3> axes;

  PlacedJoints(const KinematicTree& tree, std::span<const double> values)
      : poses(tree.link_count()), axes(tree.link_count(), Vec3::Zero()) {
    for (std::size_t l = 1; l < tree.link_count(); ++l) {  // parents come before their children
      const Joint& joint = tree.joint(id<LinkId>(l));
      poses[l] = poses[index(tree.parent(id<LinkId>(l)))] * joint.origin;
      axes[l] = product(poses[l].rotation, joint.axis);
      if (joint.has_dof()) poses[l] = poses[l] * motion(joint, values[index(tree.dof_of(id<LinkId>(l)))]);
    }
  }
};

}  // namespace

std::vector<double> joint_levers(const Robot& robot, std::span<const double> lower, std::span<const double> upper) {
  const KinematicTree& tree = robot.model().tree();
  const std::vector<std::vector<Vec3>> corners = link_corners(robot);
  std::vector<double> levers(lower.size(), 0.0), q(lower.size()), here(lower.size());
  for (std::uint64_t sample = 0; sample < lever_samples; ++sample) {
    SampleStream stream(0, sample);
    for (std::size_t j = 0; j < q.size(); ++j) q[j] = lower[j] + stream.uniform() * (upper[j] - lower[j]);
    const PlacedJoints placed(tree, robot.expand(q));
    here.assign(here.size(), 0.0);
    for (std::size_t l = 1; l < tree.link_count(); ++l) {
      if (corners[l].empty()) continue;
      for (LinkId moved = id<LinkId>(l); index(moved) != 0; moved = tree.parent(moved)) {
        const Joint& joint = tree.joint(moved);
        if (!joint.has_dof()) continue;
        double farthest = joint.kind == JointKind::prismatic ? 1.0 : 0.0;
        if (joint.kind == JointKind::revolute)
          for (const Vec3& corner : corners[l]) {
            const Vec3 arm = placed.poses[l] * corner - placed.poses[index(moved)] * joint.point;
            farthest = std::max(farthest, norm(Vec3(cross(placed.axes[index(moved)], arm))));
          }
        const Robot::Drive& drive = robot.drives()[index(tree.dof_of(moved))];
        here[drive.independent] = std::max(here[drive.independent], std::abs(drive.multiplier) * farthest);
      }
    }
    for (std::size_t j = 0; j < levers.size(); ++j) levers[j] += here[j] / static_cast<double>(lever_samples);
  }
  const double largest = levers.empty() ? 0.0 : *std::max_element(levers.begin(), levers.end());
  for (double& lever : levers) lever = std::max(lever, largest > 0.0 ? 0.01 * largest : 1.0);
  return levers;
}

double robot_size(const Robot& robot) {
  const std::vector<std::vector<Vec3>> corners = link_corners(robot);
  const std::vector<double> zero(robot.independent_joints().size(), 0.0);
  const PlacedJoints placed(robot.model().tree(), robot.expand(zero));
  Aabb box;
  for (std::size_t l = 1; l < corners.size(); ++l)
    for (const Vec3& corner : corners[l]) box.extend(placed.poses[l] * corner);
  return box.is_empty() ? 0.0 : norm(Vec3(box.upper - box.lower));
}

}  // namespace hinge::robotics
