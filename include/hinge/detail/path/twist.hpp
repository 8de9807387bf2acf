// SPDX-License-Identifier: BSD-3-Clause
// Twist and Change: velocities of rigid bodies at one state, and bounds on how they change around it.
#pragma once

#include <algorithm>

#include "hinge/core/vec3.hpp"

namespace hinge::detail {

/// A point x of the body moves at turn x x + shift.
struct Twist {
  Vec3 turn = Vec3::Zero();
  Vec3 shift = Vec3::Zero();

  Vec3 at(const Vec3& x) const noexcept { return cross(turn, x) + shift; }
  friend Twist operator+(const Twist& a, const Twist& b) noexcept { return {a.turn + b.turn, a.shift + b.shift}; }
  friend Twist operator-(const Twist& a, const Twist& b) noexcept { return {a.turn - b.turn, a.shift - b.shift}; }
};

/// Bounds that hold all over a segment of the path, for one body against another one that is held.
struct Change {
  double turning = 0.0;         ///< speed of turning
  double turning_change = 0.0;  ///< length of its derivative
  double point = 0.0;           ///< length of the second derivative of the position of the body's reference point

  /// Length of the second derivative of a vector of length 1 that turns with the body.
  double unit() const noexcept { return turning_change + turning * turning; }
};

/// Passes a joint of this speed, from a body that moves as `change` says to the one behind the joint. Half width of the
/// segment; turn: length of the turn of the body behind the joint, at the middle of the segment.
template <class JointRate>
void pass_joint(const JointRate& joint, double half, double turn, Change& change) noexcept {
  if (joint.slides) {
    change.point += 2.0 * change.turning * joint.speed;
    return;
  }
  change.turning_change += joint.speed * change.turning;
  change.turning = std::min(change.turning + joint.speed, turn + half * change.turning_change);
}

/// Above the relative rounding of bounds, which are sums and products of positive numbers: 8 u for each of 2^29 joints.
inline constexpr double bound_above = 1.0 + 0x1p-20;

// Rounding of what is computed of a group, in half ulps of its reach; docs/explanation/certified_paths.md.
inline constexpr double rounding_per_joint = 64.0;
inline constexpr double rounding_of_values = 8.0;  ///< per rad or length of a joint's value
inline constexpr double per_departure = 3.1;       ///< for an origin that is not quite a rotation
inline constexpr double share_of_rounding = 4.0;   ///< at the middle, at the state in question, and to spare

}  // namespace hinge::detail
