// SPDX-License-Identifier: BSD-3-Clause
// PoseSource: where engines get group poses from, all or one at a time, and which of them moved.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/kinematics/rigid_groups.hpp"

namespace hinge {

/// Holds the current configuration (or poses computed elsewhere) of one set of rigid groups. Forward kinematics always
/// starts from the reference, so a pose depends on the configuration alone and not on what was asked before.
class PoseSource {
 public:
  /// Starts at the reference configuration, every value 0.
  explicit PoseSource(std::shared_ptr<const RigidGroups> groups, std::size_t dof_count)
      : groups_(std::move(groups)), q_(dof_count, 0.0), poses_(groups_->size()), component_(groups_->size()) {
    for (std::size_t g = 0; g < component_.size(); ++g) component_[g] = g;
  }

  /// q: one value per selected DOF, rad or model length unit. ConfigurationError: wrong length or not finite, naming
  /// the position; the previous state is kept.
  void set_configuration(std::span<const double> q);

  /// One world pose per group; group 0 must keep the identity, it is the world. ConfigurationError: wrong number or no
  /// rigid placement, naming the group; the previous state is kept.
  void set_poses(std::span<const Pose> poses);

  /// World pose of a group; computes what is missing on the way to it.
  const Pose& pose(GroupId group) noexcept {
    while (computed_ <= index(group)) compute_next();
    return poses_[index(group)];
  }

  /// Did the group's pose change in the last set_...()? All but the world count as moved after the first.
  bool moved(GroupId group) const noexcept { return moved_.empty() || moved_[index(group)]; }

  /// Two groups of the same component kept their relative placement in the last set_...(); all differ after the first.
  std::size_t component(GroupId group) const noexcept { return component_[index(group)]; }

  /// Makes everything count as moved in the next set_...(): what engines hold was not placed by these poses.
  void forget() noexcept {
    given_ = true;
    moved_.clear();
  }

  std::size_t dof_count() const noexcept { return q_.size(); }

 private:
  void compute_next() noexcept {
    const std::size_t g = computed_++;
    if (g == 0) return;  // the world
    const RigidGroup& group = (*groups_)[id<GroupId>(g)];
    poses_[g] = poses_[index(group.parent)] * (group.joint.origin * motion(group.joint, q_[group.dof]));
  }

  std::shared_ptr<const RigidGroups> groups_;
  std::vector<double> q_;
  std::vector<Pose> poses_;
  std::size_t computed_ = 1;  // poses_[0, computed_) are up to date
  bool given_ = true;         // the last poses were set, not computed (or there were none)
  std::vector<bool> moved_;   // empty before the first set_...()
  std::vector<std::size_t> component_;
};

inline void PoseSource::set_configuration(std::span<const double> q) {
  if (q.size() != q_.size())
    throw ConfigurationError("configuration has " + std::to_string(q.size()) + " values, expected " +
                             std::to_string(q_.size()));
  for (std::size_t k = 0; k < q.size(); ++k)
    if (!is_finite(q[k]))
      throw ConfigurationError("configuration value " + std::to_string(k) + " is " + std::to_string(q[k]) +
                               ", expected a finite number");
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  moved_.resize(groups_->size());
  for (std::size_t g = 0; g < groups_->size(); ++g) {
    const RigidGroup& group = (*groups_)[id<GroupId>(g)];
    const bool changed = g != 0 && (given_ || bits(q[group.dof]) != bits(q_[group.dof]));
    moved_[g] = changed || (g != 0 && moved_[index(group.parent)]);
    component_[g] = changed || g == 0 ? g : component_[index(group.parent)];
  }
  std::copy(q.begin(), q.end(), q_.begin());
  poses_[0] = Pose{};
  computed_ = 1;
  given_ = false;
}

inline void PoseSource::set_poses(std::span<const Pose> poses) {
  if (poses.size() != groups_->size())
    throw ConfigurationError(std::to_string(poses.size()) + " poses, expected " + std::to_string(groups_->size()));
  for (std::size_t g = 0; g < poses.size(); ++g)
    if (!is_rigid(poses[g]) || (g == 0 && !(poses[0] == Pose{})))
      throw ConfigurationError("pose of rigid group " + std::to_string(g) +
                               (g == 0 ? ": the world's must be the identity" : ": not a rigid placement"));
  const bool first = moved_.empty();
  while (computed_ < groups_->size()) compute_next();
  moved_.resize(groups_->size());
  for (std::size_t g = 0; g < poses.size(); ++g) {
    moved_[g] = first || !(poses[g] == poses_[g]);
    component_[g] = moved_[g] ? g : 0;
  }
  std::copy(poses.begin(), poses.end(), poses_.begin());
  given_ = true;
}

}  // namespace hinge
