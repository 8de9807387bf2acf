// SPDX-License-Identifier: BSD-3-Clause
// RelativeMotion: the motion of two rigid groups relative to each other, from the joints between them only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/path/group_rates.hpp"
#include "hinge/detail/path/twist.hpp"

namespace hinge::detail {

/// Both motions are relative to a third group on the path between the two, which is held. Scaled like GroupRate.
struct RelativeMotion {
  std::uint32_t held = 0;
  Twist first, second;                                           ///< at the middle of the segment
  Vec3 first_point = Vec3::Zero(), second_point = Vec3::Zero();  ///< points fixed in the two groups, at the middle
  double first_unit = 0.0, second_unit = 0.0;  ///< second derivative of a vector fixed in the group, per length
  double approach = 0.0;                       ///< cheap upper bound of the approach of any two points of the groups
  double points = 0.0;                         ///< sum of the second derivatives of both points
  /// rounding of any gap between the two groups, at any state of the segment
  double rounding = 0.0;
  bool still = true;  ///< true if no joint between the two moves
};

/// Computes RelativeMotion; owns scratch memory.
class FindRelativeMotion {
 public:
  /// For groups a and b, within `half` of the middle that `groups` are set to.
  void operator()(std::span<const GroupRate> groups, std::uint32_t a, std::uint32_t b, double half,
                  RelativeMotion& motion);

 private:
  std::vector<std::uint32_t> way_, down_;
};

inline void FindRelativeMotion::operator()(std::span<const GroupRate> groups, std::uint32_t a, std::uint32_t b,
                                           double half, RelativeMotion& motion) {
  const std::uint32_t first = a, second = b;
  way_.clear();
  down_.clear();
  double turning = 0.0;
  motion.still = true;
  // Parents have smaller indices, so the larger index is never the common ancestor.
  while (a != b) {
    std::uint32_t& later = a > b ? a : b;
    const GroupRate& group = groups[later];
    (a > b ? way_ : down_).push_back(later);
    if (!group.slides) turning += group.speed;
    if (group.rate != 0.0) motion.still = false;
    later = group.parent;
  }
  const std::size_t up = way_.size();
  way_.insert(way_.end(), down_.rbegin(), down_.rend());
  // Hold the group half way, so that little rotation adds up on either side.
  std::size_t held = 0;
  for (double passed = 0.0; held < way_.size(); ++held) {
    const GroupRate& group = groups[way_[held]];
    if (!group.slides) passed += group.speed;
    if (passed > 0.5 * turning) break;
  }
  // The group behind the last joint before the split. A joint on the side of `first` has this group as its parent.
  motion.held = held == 0 ? first : held <= up ? groups[way_[held - 1]].parent : way_[held - 1];
  const double share = groups[first].rounding + groups[second].rounding;
  const auto link = [&](std::size_t k) {  // from joint k - 1 of the path to joint k
    if (k < up) return groups[way_[k - 1]].step;
    if (k > up) return groups[way_[k]].step;
    // Both joints belong to children of the common ancestor. The reference point of a sliding joint may move farther
    // away.
    const GroupRate &x = groups[way_[k - 1]], &y = groups[way_[k]];
    return norm(Vec3(x.at - y.at)) * bound_above + (x.slides ? 2.0 * x.step : 0.0) + (y.slides ? 2.0 * y.step : 0.0) +
           share * (x.reach + y.reach);
  };
  const auto pass = [&](std::size_t k, bool child, Twist& twist, Change& change, double& summed) {
    const GroupRate& group = groups[way_[k]];
    twist = child ? twist + group.joint : twist - group.joint;
    if (!group.slides) summed += group.speed;
    pass_joint(group, half, norm(twist.turn) + share_of_rounding * share * summed, change);
  };
  Change change_first, change_second;
  double summed_first = 0.0, summed_second = 0.0;
  motion.first = motion.second = Twist{};
  for (std::size_t k = held; k-- > 0;) {
    if (k + 1 < held) change_first.point += link(k + 1) * change_first.unit();
    pass(k, k < up, motion.first, change_first, summed_first);
  }
  for (std::size_t k = held; k < way_.size(); ++k) {
    if (k > held) change_second.point += link(k) * change_second.unit();
    pass(k, k >= up, motion.second, change_second, summed_second);
  }
  motion.first_point = groups[first].at;
  motion.second_point = groups[second].at;
  // If one group is an ancestor of the other, the next joint on the path is fixed in it: use that joint's point.
  const auto end_at_joint = [&](const GroupRate& joint, Vec3& point, Change& change) {
    if (joint.slides)
      change.point += joint.step * change.unit();
    else
      point = joint.at;
  };
  if (!way_.empty() && up == 0) end_at_joint(groups[way_.front()], motion.first_point, change_first);
  if (!way_.empty() && up == way_.size()) end_at_joint(groups[way_.back()], motion.second_point, change_second);
  motion.first_unit = change_first.unit() * bound_above;
  motion.second_unit = change_second.unit() * bound_above;
  motion.points = (change_first.point + change_second.point) * bound_above;
  const double turns = 1.0 + half * turning;
  motion.rounding = share_of_rounding * turns * turns * share * (groups[first].reach + groups[second].reach);
}

/// Bound of how much closer any two points of the groups can come in the segment, if their speeds at its middle add up
/// to at most `speed`. Scaled like the groups.
inline double approach(const RelativeMotion& motion, const GroupRate& a, const GroupRate& b, double half,
                       double speed) noexcept {
  const double first_radius = norm(Vec3(motion.first_point - a.centre)) + a.extent;
  const double second_radius = norm(Vec3(motion.second_point - b.centre)) + b.extent;
  const double second = motion.points + motion.first_unit * first_radius + motion.second_unit * second_radius;
  return (half * speed + 0.5 * half * half * second) * bound_above + motion.rounding;
}
/// The same with the tightest speed bounds.
inline double approach(const RelativeMotion& motion, const GroupRate& a, const GroupRate& b, double half) noexcept {
  return approach(motion, a, b, half, a.largest_speed(motion.first) + b.largest_speed(motion.second));
}

/// A cache of the relative motions in one segment: pairs of primitives come in the order of their groups.
class RelativeMotions {
 public:
  /// Call this when the middle or the half width changed.
  void forget() noexcept { ++present_; }

  /// Valid until the next call.
  const RelativeMotion& operator()(std::span<const GroupRate> groups, std::uint32_t a, std::uint32_t b, double half) {
    Kept& kept = kept_[(a * 0x9e3779b9U ^ b * 0x85ebca6bU) >> (32 - bits)];
    if (kept.segment != present_ || kept.first != a || kept.second != b) {
      kept.first = a;
      kept.second = b;
      kept.segment = present_;
      find_(groups, a, b, half, kept.motion);
      const double speed = groups[a].speed_bound(kept.motion.first) + groups[b].speed_bound(kept.motion.second);
      kept.motion.approach = approach(kept.motion, groups[a], groups[b], half, speed);
    }
    return kept.motion;
  }

 private:
  struct Kept {
    std::uint32_t first = 0, second = 0;
    std::uint64_t segment = 0;
    RelativeMotion motion;
  };
  static constexpr unsigned bits = 7;
  FindRelativeMotion find_;
  std::vector<Kept> kept_ = std::vector<Kept>(std::size_t{1} << bits);
  std::uint64_t present_ = 1;
};

}  // namespace hinge::detail
