// SPDX-License-Identifier: BSD-3-Clause
// RigidGroups: merges links that cannot move relative to each other under a DOF selection, and keeps the tree of
// groups.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/detail/kinematics/joint_batch.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/kinematics/kinematic_tree.hpp"

namespace hinge {

/// One maximal set of links with constant relative poses. Its frame is the frame of its topmost link.
struct RigidGroup {
  GroupId parent{};     ///< a group with a smaller index; group 0 (the world) is its own parent
  Joint joint{};        ///< joint to the parent group; origin: group frame in the parent group's frame
  std::size_t dof = 0;  ///< index of the joint's value in the selected configuration
};

namespace detail {
class ForwardKinematics;
}

/// Groups in topological order (parents first). Group 0 contains the world and never moves. Constant after
/// construction.
class RigidGroups {
 public:
  /// ModelError: the selection has a DOF that the tree does not have (it belongs to another tree).
  RigidGroups(const KinematicTree& tree, const DofSelection& selection) {
    if (selection.size() > 0 && index(selection.dofs().back()) >= tree.dof_count())
      throw ModelError("selected DOF " + std::to_string(index(selection.dofs().back())) +
                       ": the tree of the model has " + std::to_string(tree.dof_count()) + " DOF");
    std::vector<bool> selected(tree.dof_count(), false);
    std::vector<std::size_t> position(tree.dof_count(), 0);
    for (std::size_t k = 0; k < selection.size(); ++k) {
      selected[index(selection.dofs()[k])] = true;
      position[index(selection.dofs()[k])] = k;
    }
    group_of_.resize(tree.link_count());
    link_in_group_.resize(tree.link_count());
    groups_.emplace_back();
    for (std::size_t l = 1; l < tree.link_count(); ++l) {
      const LinkId link = id<LinkId>(l);
      const Joint& joint = tree.joint(link);
      const std::size_t parent = index(tree.parent(link));
      const Pose origin = link_in_group_[parent] * joint.origin;
      if (joint.has_dof() && selected[index(tree.dof_of(link))]) {
        RigidGroup group{group_of_[parent], joint, position[index(tree.dof_of(link))]};
        group.joint.origin = origin;
        group_of_[l] = id<GroupId>(groups_.size());
        const std::size_t place = (groups_.size() - 1) % detail::JointBatch::size;
        if (place == 0) batches_.emplace_back();
        batches_.back().set(place, group.joint, group.dof);
        groups_.push_back(std::move(group));
      } else {
        group_of_[l] = group_of_[parent];
        link_in_group_[l] = origin;
      }
    }
  }

  /// Returns the number of groups.
  std::size_t size() const noexcept { return groups_.size(); }
  /// Returns a group. The reference is valid while this object lives.
  const RigidGroup& operator[](GroupId group) const noexcept { return groups_[index(group)]; }
  /// Returns the group of a link.
  GroupId group_of(LinkId link) const noexcept { return group_of_[index(link)]; }
  /// Returns the constant pose of a link's frame in the frame of its group.
  const Pose& link_in_group(LinkId link) const noexcept { return link_in_group_[index(link)]; }

 private:
  friend class detail::ForwardKinematics;

  /// Returns the joints of groups 1 .. size() - 1 in batches of eight.
  std::span<const detail::JointBatch> joint_batches() const noexcept { return batches_; }

  std::vector<RigidGroup> groups_;
  std::vector<detail::JointBatch> batches_;
  std::vector<GroupId> group_of_;
  std::vector<Pose> link_in_group_;
};

}  // namespace hinge
