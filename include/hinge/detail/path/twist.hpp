// SPDX-License-Identifier: BSD-3-Clause
// Twist and Change: velocities of rigid bodies at one state, and bounds of their change around it.
#pragma once

#include <algorithm>

#include "hinge/core/vec3.hpp"

namespace hinge::detail {

/// The velocity of a point x of the body is turn x x + shift (cross product).
struct Twist {
  Vec3 turn = Vec3::Zero();
  Vec3 shift = Vec3::Zero();

  Vec3 at(const Vec3& x) const noexcept { return cross(turn, x) + shift; }
  friend Twist operator+(const Twist& a, const Twist& b) noexcept { return {a.turn + b.turn, a.shift + b.shift}; }
  friend Twist operator-(const Twist& a, const Twist& b) noexcept { return {a.turn - b.turn, a.shift - b.shift}; }
};

/// Bounds over a whole segment of the path, for one body relative to a body that is held fixed.
struct Change {
  double turning = 0.0;         ///< angular speed
  double turning_change = 0.0;  ///< magnitude of the angular acceleration
  double point = 0.0;           ///< magnitude of the second derivative of the body's reference point

  /// Magnitude of the second derivative of a unit vector fixed in the body.
  double unit() const noexcept { return turning_change + turning * turning; }
};

/// Extends the bounds `change` of a body across a joint to the next body. half: half width of the segment. turn:
/// angular speed of the next body at the middle of the segment.
template <class JointRate>
void pass_joint(const JointRate& joint, double half, double turn, Change& change) noexcept {
  if (joint.slides) {
    change.point += 2.0 * change.turning * joint.speed;
    return;
  }
  change.turning_change += joint.speed * change.turning;
  change.turning = std::min(change.turning + joint.speed, turn + half * change.turning_change);
}

/// Covers the rounding of bounds, which are sums and products of positive numbers: 8 u for each of 2^29 joints.
inline constexpr double bound_above = 1.0 + 0x1p-20;

// Rounding of computed points of a group, in half ulps of its reach; see docs/explanation/certified_paths.md.
inline constexpr double rounding_per_joint = 64.0;
inline constexpr double rounding_of_values = 8.0;  ///< per rad or length of a joint's value
inline constexpr double per_departure = 3.1;       ///< for an origin that deviates from a rotation
inline constexpr double share_of_rounding = 4.0;   ///< at the middle, at the state in question, and a reserve

}  // namespace hinge::detail
