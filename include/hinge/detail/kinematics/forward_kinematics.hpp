// SPDX-License-Identifier: BSD-3-Clause
// ForwardKinematics: world poses of rigid groups, computed on demand, and the groups that the last update moved.
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
#include "hinge/core/number_text.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/detail/kinematics/compose_frames.hpp"
#include "hinge/detail/kinematics/joint_batch.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/kinematics/rigid_groups.hpp"

namespace hinge::detail {

/// Holds the current configuration, or poses computed by the caller, for one set of rigid groups. Forward kinematics
/// starts from the reference, so a pose depends on the configuration alone and not on earlier calls.
class ForwardKinematics {
 public:
  /// Starts at the reference configuration: every value 0.
  explicit ForwardKinematics(std::shared_ptr<const RigidGroups> groups, std::size_t dof_count)
      : groups_(std::move(groups)),
        q_(dof_count, 0.0),
        changed_(dof_count, 0),
        frames_(groups_->size()),
        moved_(groups_->size(), 0),
        component_(groups_->size(), 0) {
    for (std::size_t g = 1; g < groups_->size(); ++g) {
      const RigidGroup& group = (*groups_)[id<GroupId>(g)];
      if (group.joint.kind == JointKind::prismatic) slides_.push_back(group.dof);
    }
  }

  /// q: one value per selected DOF, rad or model length unit. ConfigurationError: wrong length, a value that is not
  /// finite, or a prismatic value beyond largest_length; the text names the index. The previous state is then kept.
  void set_configuration(std::span<const double> q);

  /// poses: one world pose per group; group 0 is the world and must be the identity. ConfigurationError: wrong length,
  /// or a pose that is not rigid; the text names the group. The previous state is then kept.
  void set_poses(std::span<const Pose> poses);

  /// Returns the world frame of a group. Computes the missing frames up to this index.
  const Frame& frame(GroupId group) noexcept {
    if (computed_ <= index(group)) compute_through(index(group));
    return frames_[index(group)];
  }
  Pose pose(GroupId group) noexcept { return frame(group).pose(); }
  /// Returns the world frames of groups 0 to at least `last`, by index.
  std::span<const Frame> frames_through(GroupId last) noexcept {
    frame(last);
    return std::span(frames_).first(computed_);
  }

  /// Returns true when every group but the world moved in the last set_...().
  bool all_moved() const noexcept { return all_moved_; }
  /// Returns true when the group's pose changed in the last set_...(). After the first set_...() this is true for all
  /// groups but the world.
  bool moved(GroupId group) const noexcept { return all_moved_ ? group != GroupId{0} : moved_[index(group)] != 0; }

  /// Groups with equal component kept their relative pose in the last set_...(). After the first set_...() all
  /// components differ.
  std::size_t component(GroupId group) const noexcept { return all_moved_ ? index(group) : component_[index(group)]; }

  /// Returns true when so few values changed from one configuration to the next that a search for groups at rest pays
  /// off.
  bool few_changed() const noexcept { return few_changed_; }
  /// Returns true when the current poses were given by set_poses().
  bool poses_given() const noexcept { return source_ == Source::poses; }

  /// Makes the next set_...() move every group: the engines hold coordinates that do not come from these poses.
  void forget() noexcept {
    source_ = Source::none;
    few_changed_ = false;
  }

  std::size_t dof_count() const noexcept { return q_.size(); }

 private:
  enum class Source : unsigned char { none, configuration, poses };

  void find_moved() noexcept;
  void compute_through(std::size_t last) noexcept;

  std::shared_ptr<const RigidGroups> groups_;
  std::vector<double> q_;
  std::vector<std::uint8_t> changed_;  // per value: the last set_configuration() changed it
  std::vector<Frame> frames_;
  std::size_t computed_ = 1;      // frames_[0, computed_) are up to date
  std::size_t reusable_ = 1;      // frames_[computed_, reusable_) hold the previous configuration
  Source source_ = Source::none;  // of the current poses; none: the next set_...() moves every group
  bool all_moved_ = true;         // the last set_...() moved every group; moved_ and component_ are not valid
  bool few_changed_ = false;      // the last set_configuration() changed few values
  std::vector<std::uint8_t> moved_;
  std::vector<std::size_t> component_;
  std::vector<std::size_t> slides_;  // indices in q_ of prismatic joints
  JointMotions motions_{};
};

/// "Few" means at most one in this many values.
inline constexpr std::size_t few_changes_divisor = 4;

inline void ForwardKinematics::set_configuration(std::span<const double> q) {
  if (q.size() != q_.size())
    throw ConfigurationError("configuration has " + std::to_string(q.size()) + " values, expected " +
                             std::to_string(q_.size()));
  const bool finite = is_finite(q);
  for (std::size_t k = 0; !finite && k < q.size(); ++k)
    if (!is_finite(q[k]))
      throw ConfigurationError("configuration value " + std::to_string(k) + " is " + number_text(q[k]) +
                               ", expected a finite number");
  for (const std::size_t k : slides_)
    if (!is_length(q[k]))
      throw ConfigurationError("configuration value " + std::to_string(k) + " is " + number_text(q[k]) +
                               ", expected a displacement of at most 2^1000");
  const auto differs = [&](std::size_t k) {
    return std::bit_cast<std::uint64_t>(q_[k]) != std::bit_cast<std::uint64_t>(q[k]);
  };
  std::uint64_t changes = 0;
  for (std::size_t k = 0; k < q.size(); ++k) changes += differs(k) ? 1U : 0U;
  all_moved_ = source_ != Source::configuration || changes == q.size();
  few_changed_ = !all_moved_ && changes <= q.size() / few_changes_divisor;
  reusable_ = few_changed_ ? computed_ : 1;
  computed_ = 1;
  source_ = Source::configuration;
  if (!all_moved_) {
    for (std::size_t k = 0; k < q.size(); ++k) changed_[k] = differs(k);
    find_moved();
  }
  std::copy(q.begin(), q.end(), q_.begin());
}

/// Finds the groups that the last set_configuration() moved.
inline void ForwardKinematics::find_moved() noexcept {
  moved_[0] = 0;
  component_[0] = 0;
  for (std::size_t g = 1; g < groups_->size(); ++g) {
    const RigidGroup& group = (*groups_)[id<GroupId>(g)];
    const bool changed = changed_[group.dof] != 0;
    moved_[g] = changed || moved_[index(group.parent)] != 0;
    component_[g] = changed ? g : component_[index(group.parent)];
  }
}

inline void ForwardKinematics::compute_through(std::size_t last) noexcept {
  const auto batches = groups_->joint_batches();
  while (computed_ <= last) {
    // Batches start at group 1. A batch is always computed completely.
    const std::size_t batch = (computed_ - 1) / JointBatch::size;
    const std::size_t end = std::min(1 + (batch + 1) * JointBatch::size, groups_->size());
    bool ready = false;
    for (; computed_ < end; ++computed_) {
      const std::size_t g = computed_;
      if (g < reusable_ && moved_[g] == 0) continue;
      if (!ready) compute_motions(batches[batch], q_.data(), motions_);
      ready = true;
      const RigidGroup& group = (*groups_)[id<GroupId>(g)];
      const std::size_t place = (g - 1) % JointBatch::size;
      const Frame& parent = frames_[index(group.parent)];
      if ((batches[batch].has_origin >> place & 1U) == 0) {
        compose(parent, motions_.data() + place, JointBatch::size, frames_[g]);
      } else {
        Frame at;
        compose(Frame(group.joint.origin), motions_.data() + place, JointBatch::size, at);
        compose(parent, at.pose(), frames_[g]);
      }
    }
  }
}

inline void ForwardKinematics::set_poses(std::span<const Pose> poses) {
  if (poses.size() != groups_->size())
    throw ConfigurationError(std::to_string(poses.size()) + " poses, expected " + std::to_string(groups_->size()) +
                             ", one per rigid group");
  for (std::size_t g = 0; g < poses.size(); ++g)
    if (!is_rigid(poses[g]) || (g == 0 && !(poses[0] == Pose{})))
      throw ConfigurationError(
          "pose of rigid group " + std::to_string(g) +
          (g == 0 ? ": expected the identity, because this group is the world" : ": expected a rigid placement"));
  all_moved_ = source_ == Source::none;
  if (!all_moved_) compute_through(groups_->size() - 1);
  moved_[0] = 0;
  component_[0] = 0;
  for (std::size_t g = 1; g < poses.size(); ++g) {
    moved_[g] = all_moved_ || !frames_[g].is(poses[g]);
    component_[g] = moved_[g] != 0 ? g : 0;
    std::construct_at(&frames_[g], poses[g]);  // assignment would load wider than the recent stores: slow
  }
  source_ = Source::poses;
  few_changed_ = false;
  computed_ = reusable_ = groups_->size();
}

}  // namespace hinge::detail
