// SPDX-License-Identifier: BSD-3-Clause
// MoveFrames: group frames of a state and of one move from it, bit for bit those of forward kinematics.
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
#include "hinge/core/vec3.hpp"
#include "hinge/detail/core/sincos.hpp"
#include "hinge/detail/kinematics/compose_frames.hpp"
#include "hinge/detail/moves/move_cut.hpp"
#include "hinge/detail/moves/moving_parts.hpp"
#include "hinge/detail/moves/placing_bounds.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/kinematics/rigid_groups.hpp"

namespace hinge::detail {

/// A place is the position of a group in MovingParts; all calls need the same MovingParts. Motions of accepted moves
/// are stored. settle() composes frames from the root again: when a caller needs them, or when that is cheaper.
class MoveFrames {
 public:
  /// The error bound of PlacingBounds allows this many stored motions.
  static constexpr std::size_t most_kept = PlacingBounds::most_kept;

  MoveFrames(std::shared_ptr<const RigidGroups> groups, const MovingParts& parts)
      : groups_(std::move(groups)),
        at_(parts.size()),
        motion_(parts.size()),
        frame_(parts.size()),
        tried_(parts.size()),
        tried_at_(parts.size(), 0) {
    for (std::uint32_t p = 1; p < parts.size(); ++p) {
      const Joint& joint = group(p, parts).joint;
      at_[p] = {joint.axis, joint.point, {}, 0.0, joint.kind == JointKind::prismatic};
    }
  }

  /// Sets all frames to a configuration.
  void set(std::span<const double> q, const MovingParts& parts) noexcept {
    forget_kept();
    for (std::uint32_t p = 1; p < parts.size(); ++p) set_value(p, q[group(p, parts).dof], parts);
    compose_range(1, parts.size(), parts);
  }
  /// Changes joints to new values and composes the frames below them. `parts` are cut at these joints.
  void jump(std::span<const JointValue> values, const MovingParts& parts) {
    settle(parts);
    for (const auto& [place, value] : values) set_value(place, value, parts);
    for (const MovingParts::Stretch& s : parts.stretches()) compose_range(s.begin, s.end, parts);
  }

  /// Tries new values of joints, sorted by place; `parts` are cut at these joints. Computes the rigid motion of each
  /// part: transform(part) maps world coordinates before the move to world coordinates after it. undo() drops the move,
  /// keep() accepts it. At most most_kept values.
  void try_values(std::span<const JointValue> values, const MovingParts& parts) {
    // Settle when the work since the last settle() exceeds its cost: one stored motion costs about half a composed
    // frame.
    looked_through_ += kept_.size() * values.size();
    if (kept_motion_.size() + values.size() > most_kept || looked_through_ > 2 * std::size_t{parts.size()})
      settle(parts);
    ++move_;
    values_.assign(values.begin(), values.end());
    turn_.resize(values.size());
    transforms_.resize(parts.parts().size());
    for (std::size_t k = 1; k < transforms_.size(); ++k) {
      const std::uint32_t above = parts.parts()[k].parent;
      const Pose motion = motion_of(k - 1);
      if (above == 0)
        transforms_[k] = Frame(motion);
      else
        compose(transforms_[above], motion, transforms_[k]);
    }
  }
  const Frame& transform(std::uint32_t part) const noexcept { return transforms_[part]; }
  /// The frame at `place` after all stored motions and the motion of `part`.
  Frame moved(std::uint32_t place, std::uint32_t part) const noexcept {
    Frame at = frame_[place];
    const auto move_by = [&at](const Frame& by) {
      const Frame from = at;
      compose(by, from.pose(), at);
    };
    for (const Kept& k : kept_)
      if (k.moves(place)) move_by(kept_motion_[k.motion]);
    if (part != 0) move_by(transforms_[part]);
    return at;
  }

  void undo() noexcept {
    for (const auto& [place, motion] : saved_) motion_[place] = motion;
    saved_.clear();
  }
  void keep(const MovingParts& parts) {
    saved_.clear();
    for (const MovingParts::Stretch& s : parts.stretches())
      kept_.push_back({s.begin, s.end - s.begin, static_cast<std::uint32_t>(kept_motion_.size()) + s.part - 1});
    kept_motion_.insert(kept_motion_.end(), transforms_.begin() + 1, transforms_.end());
    for (std::size_t k = 0; k < values_.size(); ++k) {
      const std::uint32_t place = values_[k].first;
      at_[place].value = values_[k].second;
      at_[place].turn = turn_[k];
      changed_.push_back(place);
    }
  }

  /// Composes the frames of all moved groups from the root, as for any configuration: errors do not accumulate over
  /// moves.
  void settle(const MovingParts& parts) {
    if (kept_.empty()) return;
    for (const std::uint32_t place : changed_) set_motion(place, at_[place].value, parts);
    std::sort(kept_.begin(), kept_.end(), [](const Kept& x, const Kept& y) { return x.begin < y.begin; });
    std::uint32_t done = 1;
    for (const Kept& k : kept_) {
      compose_range(std::max(done, k.begin), k.begin + k.count, parts);
      done = std::max(done, k.begin + k.count);
    }
    forget_kept();
  }
  /// Frames of the state. Only valid when settled.
  const Frame& frame(std::uint32_t place) const noexcept { return frame_[place]; }
  std::span<const Frame> frames() const noexcept { return frame_; }

  /// The frame at `place` after the tried move, composed once along the path from the groups that do not move.
  const Frame& tried(std::uint32_t place, const MovingParts& parts) {
    if (saved_.empty()) {
      settle(parts);
      for (const auto& [joint, value] : values_) {
        saved_.emplace_back(joint, motion_[joint]);
        set_motion(joint, value, parts);
      }
    }
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
  struct JointAt {
    Vec3 axis = Vec3::UnitZ(), point = Vec3::Zero();  // in the group's frame
    SinCos turn;                                      // sine and cosine of the value, for a revolute joint
    double value = 0.0;
    bool slides = false;
  };
  /// The places begin .. begin + count - 1 were moved by one motion.
  struct Kept {
    std::uint32_t begin, count, motion;  // in kept_motion_
    bool moves(std::uint32_t place) const noexcept { return place - begin < count; }
  };
  using Motion = std::array<double, 12>;  // rotation column by column, then translation; relative to the parent group

  const RigidGroup& group(std::uint32_t place, const MovingParts& parts) const noexcept {
    return (*groups_)[parts.group(place)];
  }
  void set_value(std::uint32_t place, double value, const MovingParts& parts) noexcept {
    at_[place].value = value;
    if (!at_[place].slides) at_[place].turn = sincos(value);
    set_motion(place, value, parts);
  }
  /// Same order of operations as ForwardKinematics.
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
  void forget_kept() noexcept {
    kept_.clear();
    kept_motion_.clear();
    changed_.clear();
    looked_through_ = 0;
  }

  /// The rigid motion of everything below joint values_[k], about the joint's axis in the state, world frame.
  Pose motion_of(std::size_t k) noexcept {
    const auto& [place, value] = values_[k];
    const JointAt& joint = at_[place];
    const FrameColumns at(frame_[place]);
    std::array<double, 4> u, c;
    at.turn(joint.axis[0], joint.axis[1], joint.axis[2]).store(u.data());
    at.place(joint.point[0], joint.point[1], joint.point[2]).store(c.data());
    for (const Kept& kept : kept_)
      if (kept.moves(place)) {
        const FrameColumns by(kept_motion_[kept.motion]);
        by.turn(u[0], u[1], u[2]).store(u.data());
        by.place(c[0], c[1], c[2]).store(c.data());
      }
    Vec3 direction(u[0], u[1], u[2]);
    direction /= norm(direction);
    Pose by;
    if (joint.slides) {
      by.translation = direction * (value - joint.value);
      return by;
    }
    const SinCos from = joint.turn, to = turn_[k] = sincos(value);
    const auto columns = rotation_columns(direction[0], direction[1], direction[2],
                                          to.sin * from.cos - to.cos * from.sin, to.cos * from.cos + to.sin * from.sin);
    std::copy_n(columns.data(), 9, by.rotation.data());
    const Vec3 point(c[0], c[1], c[2]);
    by.translation = point - product(by.rotation, point);
    return by;
  }

  std::shared_ptr<const RigidGroups> groups_;
  std::vector<JointAt> at_;              // in the state
  std::vector<Motion> motion_;           // of the settled state; while saved_ is not empty, of the tried move
  std::vector<Frame> frame_, tried_;     // frame_: of the settled state
  std::vector<std::uint64_t> tried_at_;  // per place: the move whose frame is in tried_
  std::uint64_t move_ = 0;
  // Moves accepted since settle(), in order.
  std::vector<Kept> kept_;
  std::vector<Frame> kept_motion_;
  std::vector<std::uint32_t> changed_;
  std::size_t looked_through_ = 0;  // number of stored motions applied since settle()
  // The tried move.
  std::vector<JointValue> values_;
  std::vector<SinCos> turn_;       // per entry of values_
  std::vector<Frame> transforms_;  // per part
  std::vector<std::pair<std::uint32_t, Motion>> saved_;
  std::vector<std::uint32_t> way_;  // scratch
};

}  // namespace hinge::detail
