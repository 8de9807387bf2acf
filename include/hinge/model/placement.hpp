// SPDX-License-Identifier: BSD-3-Clause
// Placement: world coordinates of the primitives of a selected model, computed group by group on demand.
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
#include "hinge/detail/kinematics/pose_source.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge {

/// The state of an engine. It is the single definition of world coordinates: pose * primitive for a configuration or
/// poses, or the given coordinates. Not thread-safe: use one object per thread, also for the non-const queries below.
template <Primitive P>
class Placement {
 public:
  /// Starts at the reference configuration: all DOF values 0.
  explicit Placement(std::shared_ptr<const SelectedModel<P>> model)
      : model_(std::move(model)),
        poses_(model_->groups(), model_->selection().size()),
        placed_(model_->primitives().begin(), model_->primitives().end()),
        moved_at_(model_->groups()->size(), 0),
        placed_at_(model_->groups()->size(), 0) {}

  /// q: one value per selected DOF, rad or model length unit. ConfigurationError: see PoseSource::set_configuration.
  void update(std::span<const double> q) {
    if (source_ == Source::coordinates) poses_.forget();
    poses_.set_configuration(q);
    begin(Source::configuration);
  }

  /// poses: one world pose per rigid group. ConfigurationError: see PoseSource::set_poses.
  void update_poses(std::span<const Pose> poses) {
    if (source_ == Source::coordinates) poses_.forget();
    poses_.set_poses(poses);
    begin(Source::poses);
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
    if (source_ == Source::coordinates) return;
    const Pose pose = poses_.pose(group);
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
    const Pose pose = poses_.frame(group).pose();
    for (const std::uint32_t i : primitives) *to++ = local[i].placed(pose);
  }
  /// Returns the world coordinates of one primitive. Not valid after update_placed.
  P alone(PrimitiveId i) noexcept {
    const P& local = model_->primitives()[index(i)];
    const GroupId group = model_->group_of(i);
    return group == GroupId{0} ? local : local.placed(poses_.frame(group).pose());
  }

  /// Returns the number of the last update. The initial state has number 1.
  std::uint64_t update_number() const noexcept { return update_; }
  /// Returns the number of the last update that may have moved the group. Data derived from earlier coordinates is
  /// stale.
  std::uint64_t version(GroupId group) noexcept {
    settle();
    return group == GroupId{0} ? world_moved_at_ : std::max(all_moved_at_, moved_at_[index(group)]);
  }
  /// Returns true when the last update changed so few DOF that engines should look for groups at rest.
  bool few_moved() const noexcept { return source_ == Source::configuration && poses_.few_changed(); }

  /// Returns true when queries must skip the pair in the current state. With a configuration, these are the pairs of
  /// constant distance. With given poses, only the pairs inside one group. With given coordinates, none: their geometry
  /// may differ.
  bool constant(PrimitiveId i, PrimitiveId j) const noexcept {
    if (source_ == Source::configuration) return model_->constant(i, j);
    return source_ == Source::poses && model_->group_of(i) == model_->group_of(j);
  }

  /// Returns true when pairs inside one rigid group must be tested.
  bool groups_may_deform() const noexcept { return source_ == Source::coordinates; }

  /// Returns true when the distance of the two groups may have changed in the last update.
  bool moved_apart(GroupId g, GroupId h) noexcept {
    return source_ == Source::coordinates || poses_.component(g) != poses_.component(h);
  }
  /// Returns the component of a group. Groups with equal component kept their relative pose in the last update. Only
  /// valid while groups_may_deform() is false.
  std::size_t component(GroupId g) noexcept { return poses_.component(g); }
  /// Returns true when the world coordinates of the group may have changed in the last update.
  bool moved(GroupId g) noexcept { return source_ == Source::coordinates || version(g) == update_; }

  /// Returns the world pose of a group. Not valid after update_placed.
  Pose pose(GroupId group) noexcept { return poses_.pose(group); }
  /// Returns the world frame of a group, valid until the next update. Not valid after update_placed.
  const Frame& frame(GroupId group) noexcept { return poses_.frame(group); }
  /// Returns the world frames of groups 0 to `last` or more, valid until the next update. Not valid after
  /// update_placed.
  std::span<const Frame> frames_through(GroupId last) noexcept { return poses_.frames_through(last); }

 private:
  enum class Source : unsigned char { configuration, poses, coordinates };

  void begin(Source source) noexcept {
    if (!settled_) all_moved_at_ = update_;  // settle() was never called for the previous update
    ++update_;
    settled_ = false;
    if (source_ == Source::coordinates || source == Source::coordinates) {
      all_moved_at_ = world_moved_at_ = update_;
      settled_ = true;
    }
    source_ = source;
    if (few_moved()) settle();
  }

  /// Finds the groups that moved in the last update.
  void settle() noexcept {
    if (settled_) return;
    settled_ = true;
    for (std::size_t g = 1; g < moved_at_.size(); ++g)
      if (poses_.moved(id<GroupId>(g))) moved_at_[g] = update_;
  }

  std::shared_ptr<const SelectedModel<P>> model_;
  detail::PoseSource poses_;
  std::vector<P> placed_;
  std::uint64_t update_ = 1;
  std::uint64_t all_moved_at_ = 1;
  std::uint64_t world_moved_at_ = 1;
  bool settled_ = true;                   // moved_at_ includes the last update
  std::vector<std::uint64_t> moved_at_;   // per group: number of the update that last moved it
  std::vector<std::uint64_t> placed_at_;  // per group: version() of its values in placed_
  Source source_ = Source::configuration;
};

template <Primitive P>
void Placement<P>::update_placed(std::span<const P> placed) {
  if (placed.size() != placed_.size())
    throw ConfigurationError(std::to_string(placed.size()) + " placed primitives, expected " +
                             std::to_string(placed_.size()));
  for (std::size_t i = 0; i < placed.size(); ++i)
    if (!is_sound(placed[i]))
      throw ConfigurationError("placed primitive " + std::to_string(i) + ": " + flaw_of(placed[i]));
  std::copy(placed.begin(), placed.end(), placed_.begin());
  begin(Source::coordinates);
}

}  // namespace hinge
