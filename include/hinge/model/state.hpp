// SPDX-License-Identifier: BSD-3-Clause
// State: where the primitives of a selected model are, computed group by group on demand.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/detail/kinematics/forward_kinematics.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge {

/// The current configuration, poses or coordinates of a model. It is the single definition of world coordinates: pose *
/// primitive for a configuration or poses, or the given coordinates. Not thread-safe: use one object per thread, also
/// for the non-const functions below.
template <Primitive P>
class State {
 public:
  /// Starts at the reference configuration: all DOF values 0.
  explicit State(std::shared_ptr<const SelectedModel<P>> model)
      : model_(std::move(model)),
        kinematics_(model_->groups(), model_->selection().size()),
        placed_(model_->primitives().begin(), model_->primitives().end()),
        moved_at_(model_->groups()->size(), 1),
        placed_at_(model_->groups()->size(), 0) {}

  /// q: one value per selected DOF, rad or model length unit. ConfigurationError: see
  /// detail::ForwardKinematics::set_configuration.
  void update(std::span<const double> q) {
    kinematics_.set_configuration(q);
    begin(false);
  }

  /// poses: one world pose per rigid group. ConfigurationError: see
  /// detail::ForwardKinematics::set_poses.
  void update_poses(std::span<const Pose> poses) {
    kinematics_.set_poses(poses);
    begin(false);
  }

  /// placed: world coordinates of every primitive, computed by the caller. ConfigurationError: wrong length, or a
  /// primitive that fails is_sound. The previous state is then kept.
  void update_placed(std::span<const P> placed);

  /// Returns the selected model, valid while this object lives.
  const SelectedModel<P>& model() const noexcept { return *model_; }

  /// Returns the world coordinates of all primitives. A group's values are stale until place(group) is called after an
  /// update.
  std::span<const P> placed() const noexcept { return placed_; }

  /// Updates the world coordinates of all primitives and returns them.
  std::span<const P> place_all() noexcept {
    for (std::size_t g = 0; g < model_->groups()->size(); ++g) place(id<GroupId>(g));
    return placed_;
  }
  /// Updates the world coordinates of a group's primitives in placed().
  void place(GroupId group) noexcept {
    const std::uint64_t now = version(group);
    if (placed_at_[index(group)] == now) return;
    placed_at_[index(group)] = now;
    if (coordinates_given_) return;
    const Pose pose = kinematics_.pose(group);
    // Skip the identity: multiplication would change the sign of negative zeros.
    const bool still = group == GroupId{0};
    const auto local = model_->primitives();
    for (const PrimitiveId i : model_->primitives_of(group))
      placed_[index(i)] = still ? local[index(i)] : local[index(i)].placed(pose);
  }

  /// Writes the world coordinates of the listed primitives of a group to `to`. Not valid after update_placed.
  void place(GroupId group, std::span<const std::uint32_t> primitives, P* to) noexcept {
    const auto local = model_->primitives();
    if (group == GroupId{0}) {
      for (const std::uint32_t i : primitives) *to++ = local[i];
      return;
    }
    const Pose pose = kinematics_.frame(group).pose();
    for (const std::uint32_t i : primitives) *to++ = local[i].placed(pose);
  }
  /// Returns the world coordinates of one primitive. Not valid after update_placed.
  P alone(PrimitiveId i) noexcept {
    const P& local = model_->primitives()[index(i)];
    const GroupId group = model_->group_of(i);
    return group == GroupId{0} ? local : local.placed(kinematics_.frame(group).pose());
  }

  /// Returns the number of the last update. The initial state has number 1.
  std::uint64_t update_number() const noexcept { return update_; }
  /// Returns the number of the last update that may have moved the group. Data derived from earlier coordinates is
  /// stale.
  std::uint64_t version(GroupId group) const noexcept {
    const std::uint64_t at = moved_at_[index(group)];
    return group == GroupId{0} ? at : std::max(all_moved_at_, at);
  }
  /// Returns true when the last update changed so few DOF that engines should look for groups at rest.
  bool few_moved() const noexcept { return kinematics_.few_changed(); }

  /// Returns true when queries must skip the pair in the current state. With a configuration, these are the pairs of
  /// constant distance. With given poses, only the pairs inside one group. With given coordinates, none: their geometry
  /// may differ.
  bool constant(PrimitiveId i, PrimitiveId j) const noexcept {
    if (coordinates_given_) return false;
    return kinematics_.poses_given() ? model_->group_of(i) == model_->group_of(j) : model_->constant(i, j);
  }

  /// Returns true when pairs inside one rigid group must be tested.
  bool groups_may_deform() const noexcept { return coordinates_given_; }

  /// Returns true when the poses of the groups follow from the values of the joints.
  bool follows_joints() const noexcept { return !coordinates_given_ && !kinematics_.poses_given(); }

  /// Returns true when the distance of the two groups may have changed in the last update.
  bool moved_apart(GroupId g, GroupId h) const noexcept {
    return coordinates_given_ || kinematics_.component(g) != kinematics_.component(h);
  }
  /// Returns the component of a group. Groups with equal component kept their relative pose in the last update. Only
  /// valid while groups_may_deform() is false.
  std::size_t component(GroupId g) const noexcept { return kinematics_.component(g); }
  /// Returns true when the world coordinates of the group may have changed in the last update.
  bool moved(GroupId g) const noexcept { return version(g) == update_; }

  /// Returns the world pose of a group. Not valid after update_placed.
  Pose pose(GroupId group) noexcept { return kinematics_.pose(group); }
  /// Returns the world frame of a group, valid until the next update. Not valid after update_placed.
  const Frame& frame(GroupId group) noexcept { return kinematics_.frame(group); }
  /// Returns the world frames of groups 0 to `last` or more, valid until the next update. Not valid after
  /// update_placed.
  std::span<const Frame> frames_through(GroupId last) noexcept { return kinematics_.frames_through(last); }

 private:
  /// Numbers the update and records which groups it may have moved.
  void begin(bool coordinates_given) noexcept {
    ++update_;
    if (coordinates_given_ || coordinates_given)
      std::fill(moved_at_.begin(), moved_at_.end(), update_);
    else if (kinematics_.all_moved())
      all_moved_at_ = update_;
    else
      for (std::size_t g = 1; g < moved_at_.size(); ++g)
        if (kinematics_.moved(id<GroupId>(g))) moved_at_[g] = update_;
    coordinates_given_ = coordinates_given;
  }

  std::shared_ptr<const SelectedModel<P>> model_;
  detail::ForwardKinematics kinematics_;
  std::vector<P> placed_;
  std::uint64_t update_ = 1;
  std::uint64_t all_moved_at_ = 1;        // number of the last update that may have moved every group but the world
  std::vector<std::uint64_t> moved_at_;   // per group: number of the last other update that may have moved it
  std::vector<std::uint64_t> placed_at_;  // per group: version() of its values in placed_
  bool coordinates_given_ = false;        // the caller gave the world coordinates in the last update
};

template <Primitive P>
void State<P>::update_placed(std::span<const P> placed) {
  if (placed.size() != placed_.size())
    throw ConfigurationError(std::to_string(placed.size()) + " placed primitives, expected " +
                             std::to_string(placed_.size()));
  for (std::size_t i = 0; i < placed.size(); ++i)
    if (!is_sound(placed[i]))
      throw ConfigurationError("placed primitive " + std::to_string(i) + ": " + flaw_of(placed[i]));
  std::copy(placed.begin(), placed.end(), placed_.begin());
  kinematics_.forget();
  begin(true);
}

}  // namespace hinge
