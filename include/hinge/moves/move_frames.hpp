// SPDX-License-Identifier: BSD-3-Clause
// MoveFrames: frames of a configuration and of one move away from it, with the bits forward kinematics gives them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/moves/move_cut.hpp"
#include "hinge/moves/moving_parts.hpp"

namespace hinge {

/// Holds the motion of every joint, so that frames are composed again without sines. By places of MovingParts, which
/// must be the same one in all calls.
class MoveFrames {
 public:
  MoveFrames(std::shared_ptr<const RigidGroups> groups, const MovingParts& parts)
      : groups_(std::move(groups)),
        motion_(parts.size()),
        frame_(parts.size()),
        tried_(parts.size()),
        tried_at_(parts.size(), 0) {}

  /// All frames at a configuration.
  void set(std::span<const double> q, const MovingParts& parts) noexcept {
    for (std::uint32_t p = 1; p < parts.size(); ++p) set_motion(p, q[group(p, parts).dof], parts);
    compose_range(1, parts.size(), parts);
  }

  /// Joints get new values, the tree is cut there, and the rigid motion of each part is found: T(part) takes world
  /// coordinates before the move to those after it. Undone by undo(), made to stay by keep().
  void try_values(std::span<const JointValue> values, const MovingParts& parts) {
    ++move_;
    saved_.clear();
    for (const auto& [place, value] : values) {
      saved_.emplace_back(place, motion_[place]);
      set_motion(place, value, parts);
    }
    transforms_.resize(parts.parts().size());
    for (std::size_t k = 1; k < transforms_.size(); ++k) {
      const MovingParts::Part& part = parts.parts()[k];
      const Pose above = frame_[parts.parent(part.joint)].pose();
      Frame moved;
      const Frame parent(part.parent == 0 ? above : transforms_[part.parent] * above);
      compose(parent, motion_[part.joint].data(), 1, moved);
      transforms_[k] = moved.pose() * frame_[part.joint].pose().inverse();
    }
  }
  const Pose& transform(std::uint32_t part) const noexcept { return transforms_[part]; }
  /// A frame of the part as that motion takes it along.
  Frame moved(std::uint32_t place, std::uint32_t part) const noexcept {
    return part == 0 ? frame_[place] : Frame(transforms_[part] * frame_[place].pose());
  }

  void undo() noexcept {
    for (const auto& [place, motion] : saved_) motion_[place] = motion;
    saved_.clear();
  }

  /// Frames of what moves are composed from the root, as for any configuration: no move leaves a trace in them.
  void keep(const MovingParts& parts) noexcept {
    saved_.clear();
    for (const MovingParts::Stretch& s : parts.stretches()) compose_range(s.begin, s.end, parts);
  }

  const Frame& frame(std::uint32_t place) const noexcept { return frame_[place]; }
  std::span<const Frame> frames() const noexcept { return frame_; }

  /// After the move that is tried; composed along the way from what stands still, once.
  const Frame& tried(std::uint32_t place, const MovingParts& parts) {
    const std::uint32_t part = parts.part_of(place);
    if (part == 0) return frame_[place];
    const std::uint32_t above = parts.parent(parts.parts()[part].top);
    way_.clear();
    std::uint32_t p = place;
    for (; p != above && tried_at_[p] != move_; p = parts.parent(p)) way_.push_back(p);
    const Frame* from = p == above ? &frame_[p] : &tried_[p];
    for (std::size_t k = way_.size(); k-- > 0;) {
      const std::uint32_t next = way_[k];
      compose(*from, motion_[next].data(), 1, tried_[next]);
      tried_at_[next] = move_;
      from = &tried_[next];
    }
    return *from;
  }

 private:
  const RigidGroup& group(std::uint32_t place, const MovingParts& parts) const noexcept {
    return (*groups_)[parts.group(place)];
  }
  /// In the order of operations of PoseSource.
  void set_motion(std::uint32_t place, double value, const MovingParts& parts) noexcept {
    const Joint& joint = group(place, parts).joint;
    Pose at = motion(joint, value);
    if (!(joint.origin == Pose{})) {
      Frame from_origin;
      compose(Frame(joint.origin), at, from_origin);
      at = from_origin.pose();
    }
    std::copy_n(at.rotation.data(), 9, motion_[place].data());
    std::copy_n(at.translation.data(), 3, motion_[place].data() + 9);
  }
  void compose_range(std::uint32_t begin, std::uint32_t end, const MovingParts& parts) noexcept {
    for (std::uint32_t p = begin; p < end; ++p) compose(frame_[parts.parent(p)], motion_[p].data(), 1, frame_[p]);
  }

  using Motion = std::array<double, 12>;  // rotation column by column, translation; relative to the parent group

  std::shared_ptr<const RigidGroups> groups_;
  std::vector<Motion> motion_;
  std::vector<Frame> frame_, tried_;
  std::vector<std::uint64_t> tried_at_;  // per place: the move whose frame is in tried_
  std::uint64_t move_ = 0;
  std::vector<std::pair<std::uint32_t, Motion>> saved_;
  std::vector<Pose> transforms_;    // per part
  std::vector<std::uint32_t> way_;  // scratch
};

}  // namespace hinge
