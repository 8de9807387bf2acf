// SPDX-License-Identifier: BSD-3-Clause
// Placement: the world coordinates of a selected model's primitives, made group by group when an engine asks.
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

/// The state every engine starts from. Coordinates are defined here once: pose * primitive for a configuration or
/// poses, as given otherwise. One per thread.
template <Primitive P>
class Placement {
 public:
  explicit Placement(std::shared_ptr<const SelectedModel<P>> model)
      : model_(std::move(model)),
        poses_(model_->groups(), model_->selection().size()),
        placed_(model_->primitives().begin(), model_->primitives().end()),
        moved_at_(model_->groups()->size(), 0),
        placed_at_(model_->groups()->size(), 0) {}

  /// See PoseSource::set_configuration.
  void update(std::span<const double> q) {
    if (source_ == Source::coordinates) poses_.forget();
    poses_.set_configuration(q);
    begin(Source::configuration);
  }

  /// See PoseSource::set_poses.
  void update_poses(std::span<const Pose> poses) {
    if (source_ == Source::coordinates) poses_.forget();
    poses_.set_poses(poses);
    begin(Source::poses);
  }

  /// World coordinates of every primitive, computed elsewhere. ConfigurationError: wrong number, or a primitive that
  /// is not sound; the previous state is kept.
  void update_placed(std::span<const P> placed);

  const SelectedModel<P>& model() const noexcept { return *model_; }

  /// World coordinates of all primitives; those of groups not yet asked for by place() are stale.
  std::span<const P> placed() const noexcept { return placed_; }

  /// Brings the primitives of a group up to date.
  void place(GroupId group) noexcept {
    const std::uint64_t now = version(group);
    if (placed_at_[index(group)] == now) return;
    placed_at_[index(group)] = now;
    if (source_ == Source::coordinates) return;
    const Pose pose = poses_.pose(group);
    // The identity is skipped so that coordinates keep their bits, negative zeros included.
    const bool still = group == GroupId{0};
    const auto local = model_->primitives();
    for (const PrimitiveId i : model_->primitives_of(group))
      placed_[index(i)] = still ? local[index(i)] : local[index(i)].placed(pose);
  }

  /// World coordinates of some primitives of a group, written to `to`; not from coordinates computed elsewhere.
  void place(GroupId group, std::span<const std::uint32_t> primitives, P* to) noexcept {
    const auto local = model_->primitives();
    if (group == GroupId{0}) {
      for (const std::uint32_t i : primitives) *to++ = local[i];
      return;
    }
    const Pose pose = poses_.frame(group).pose();
    for (const std::uint32_t i : primitives) *to++ = local[i].placed(pose);
  }
  /// The same of one primitive.
  P alone(PrimitiveId i) noexcept {
    const P& local = model_->primitives()[index(i)];
    const GroupId group = model_->group_of(i);
    return group == GroupId{0} ? local : local.placed(poses_.frame(group).pose());
  }

  /// The number of the last update. Starts at 1.
  std::uint64_t update_number() const noexcept { return update_; }
  /// The last update that may have changed the coordinates of the group: what was built from them before it is stale.
  std::uint64_t version(GroupId group) noexcept {
    settle();
    return group == GroupId{0} ? world_moved_at_ : std::max(all_moved_at_, moved_at_[index(group)]);
  }
  /// Did so little move in the last update that engines should look for what stood still?
  bool few_moved() const noexcept { return source_ == Source::configuration && poses_.few_changed(); }

  /// Is the pair left out for the present coordinates? With a configuration, constant pairs are; with poses from
  /// elsewhere only pairs inside one group; coordinates from elsewhere bring their own geometry, so there every pair
  /// counts.
  bool constant(PrimitiveId i, PrimitiveId j) const noexcept {
    if (source_ == Source::configuration) return model_->constant(i, j);
    return source_ == Source::poses && model_->group_of(i) == model_->group_of(j);
  }

  /// Do the coordinates come from a configuration, so that pairs across an axis are constant as well?
  bool from_configuration() const noexcept { return source_ == Source::configuration; }
  /// Must pairs inside one rigid group be tested?
  bool groups_may_deform() const noexcept { return source_ == Source::coordinates; }

  /// Could the distance of these two groups have changed in the last update?
  bool moved_apart(GroupId g, GroupId h) noexcept {
    return source_ == Source::coordinates || poses_.component(g) != poses_.component(h);
  }
  /// Groups of equal component kept their relative placement in the last update; only when groups do not deform.
  std::size_t component(GroupId g) noexcept { return poses_.component(g); }
  /// Could the world coordinates of the group have changed in the last update?
  bool moved(GroupId g) noexcept { return source_ == Source::coordinates || version(g) == update_; }

  /// The pose of a group; only when the coordinates come from a configuration or poses.
  Pose pose(GroupId group) noexcept { return poses_.pose(group); }
  const Frame& frame(GroupId group) noexcept { return poses_.frame(group); }
  std::span<const Frame> frames_through(GroupId last) noexcept { return poses_.frames_through(last); }

 private:
  enum class Source : unsigned char { configuration, poses, coordinates };

  void begin(Source source) noexcept {
    if (!settled_) all_moved_at_ = update_;  // nobody asked what the update before this one moved
    ++update_;
    settled_ = false;
    if (source_ == Source::coordinates || source == Source::coordinates) {
      all_moved_at_ = world_moved_at_ = update_;
      settled_ = true;
    }
    source_ = source;
    if (few_moved()) settle();
  }

  /// Finds out which groups the last update moved.
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
  bool settled_ = true;                   // moved_at_ knows about the last update
  std::vector<std::uint64_t> moved_at_;   // per group: an update
  std::vector<std::uint64_t> placed_at_;  // per group: the version placed_ holds
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
