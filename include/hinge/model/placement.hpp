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
#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/kinematics/pose_source.hpp"
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
        version_(model_->groups()->size(), 1),
        placed_version_(model_->groups()->size(), 0) {}

  /// See PoseSource::set_configuration.
  void update(std::span<const double> q) {
    if (source_ == Source::coordinates) poses_.forget();
    poses_.set_configuration(q);
    take_poses(Source::configuration);
  }

  /// See PoseSource::set_poses.
  void update_poses(std::span<const Pose> poses) {
    if (source_ == Source::coordinates) poses_.forget();
    poses_.set_poses(poses);
    take_poses(Source::poses);
  }

  /// World coordinates of every primitive, computed elsewhere. ConfigurationError: wrong number, or bounds not finite.
  void update_placed(std::span<const P> placed);

  const SelectedModel<P>& model() const noexcept { return *model_; }

  /// World coordinates of all primitives; those of groups not yet asked for by place() are stale.
  std::span<const P> placed() const noexcept { return placed_; }

  /// Brings the primitives of a group up to date.
  void place(GroupId group) noexcept {
    const std::size_t g = index(group);
    if (placed_version_[g] == version_[g]) return;
    placed_version_[g] = version_[g];
    if (source_ == Source::coordinates) return;
    const Pose& pose = poses_.pose(group);
    const auto local = model_->primitives();
    // The identity is skipped so that coordinates keep their bits, negative zeros included.
    const bool still = pose == Pose{};
    for (const PrimitiveId i : model_->primitives_of(group))
      placed_[index(i)] = still ? local[index(i)] : local[index(i)].placed(pose);
  }

  /// Changes whenever the coordinates of the group may have changed: what was built from them is stale.
  std::uint64_t version(GroupId group) const noexcept { return version_[index(group)]; }

  /// Is the pair left out for the present coordinates? With a configuration, constant pairs are; with poses from
  /// elsewhere only pairs inside one group; coordinates from elsewhere bring their own geometry, so there every pair
  /// counts.
  bool constant(PrimitiveId i, PrimitiveId j) const noexcept {
    if (source_ == Source::configuration) return model_->constant(i, j);
    return source_ == Source::poses && model_->group_of(i) == model_->group_of(j);
  }

  /// Must pairs inside one rigid group be tested?
  bool groups_may_deform() const noexcept { return source_ == Source::coordinates; }

  /// Could the distance of these two groups have changed in the last update?
  bool moved_apart(GroupId g, GroupId h) const noexcept {
    return source_ == Source::coordinates || poses_.component(g) != poses_.component(h);
  }
  /// Could the world coordinates of the group have changed in the last update?
  bool moved(GroupId g) const noexcept { return source_ == Source::coordinates || poses_.moved(g); }

  /// The pose of a group; only when the coordinates come from a configuration or poses.
  const Pose& pose(GroupId group) noexcept { return poses_.pose(group); }

 private:
  enum class Source : unsigned char { configuration, poses, coordinates };

  void take_poses(Source source) noexcept {
    const bool all = source_ == Source::coordinates;
    source_ = source;
    for (std::size_t g = 0; g < version_.size(); ++g)
      if (all || poses_.moved(id<GroupId>(g))) ++version_[g];
  }

  std::shared_ptr<const SelectedModel<P>> model_;
  PoseSource poses_;
  std::vector<P> placed_;
  std::vector<std::uint64_t> version_;         // per group
  std::vector<std::uint64_t> placed_version_;  // per group: the version placed_ holds
  Source source_ = Source::configuration;
};

template <Primitive P>
void Placement<P>::update_placed(std::span<const P> placed) {
  if (placed.size() != placed_.size())
    throw ConfigurationError(std::to_string(placed.size()) + " placed primitives, expected " +
                             std::to_string(placed_.size()));
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const Aabb box = placed[i].bounds();
    if (!is_finite(box.lower) || !is_finite(box.upper))
      throw ConfigurationError("placed primitive " + std::to_string(i) + ": its bounds are not finite");
  }
  std::copy(placed.begin(), placed.end(), placed_.begin());
  for (std::uint64_t& version : version_) ++version;
  source_ = Source::coordinates;
}

}  // namespace hinge
