// SPDX-License-Identifier: BSD-3-Clause
// LaneError: bounds of the error of positions computed in float lanes, compared to the double coordinates of verdicts.
#pragma once

#include <algorithm>

namespace hinge::detail {

/// Lengths of one joint, model length unit.
struct JointLengths {
  double offset = 0.0;  ///< from the parent's lane frame to this one, slide included
  double detour = 0.0;  ///< sum of the lengths that the double computation adds between the two frames
};

/// Bounds for the lane frame of one rigid group, model length unit. Derivation: docs/explanation/sphere_batch.md.
class LaneError {
 public:
  /// The world's frame; the lanes' origin is at distance `shift` from the world's origin.
  explicit LaneError(double shift) noexcept : shift_(shift) {}

  /// The bounds of a child group.
  LaneError after(const JointLengths& joint) const noexcept {
    LaneError next(shift_);
    const double length = stretch_ * joint.offset;
    next.stretch_ = stretch_ * slack;
    next.reach_ = (reach_ + length) * slack;
    const double turned = rotation_ + 25 * u * (stretch_ + rotation_);
    next.rotation_ = turned * slack;
    next.translation_ = (translation_ + turned * length + 4 * u * next.reach_) * slack;
    next.exact_rotation_ = (exact_rotation_ + 64 * v) * slack;
    next.exact_translation_ =
        (exact_translation_ + next.exact_rotation_ * joint.detour + 64 * v * (shift_ + next.reach_)) * slack;
    return next;
  }

  /// Bound for a point at distance `length` from the lane frame's origin. detour: sum of lengths in its double
  /// computation.
  double of_point(double length, double detour) const noexcept {
    const double in_float =
        (rotation_ + 10 * u * (stretch_ + rotation_)) * length + translation_ + 4 * u * reach(length);
    const double in_double =
        exact_translation_ + (exact_rotation_ + 64 * v) * detour + 64 * v * (shift_ + reach(length));
    return in_float + in_double;
  }
  /// Largest distance of such a point from the lanes' origin.
  double reach(double length) const noexcept { return reach_ + stretch_ * length; }
  /// Bound of the factor by which distances in a group grow: joint origins are rigid only within rigid_tolerance.
  double stretch() const noexcept { return stretch_; }

  static constexpr double u = 0x1p-24;  ///< relative error of one rounding to float
  static constexpr double v = 0x1p-53;  ///< relative error of one rounding to double

 private:
  // Per joint: second-order terms (25 u), and origins that are rigid only within 1e-9. 32 u is above their sum.
  static constexpr double slack = 1.0 + 32 * u;

  double shift_;
  double stretch_ = 1.0;                                   // norm of the exact matrix
  double reach_ = 0.0;                                     // distance of the lane frame's origin from the lanes' origin
  double rotation_ = 0.0, translation_ = 0.0;              // lanes compared to real arithmetic
  double exact_rotation_ = 0.0, exact_translation_ = 0.0;  // double compared to real arithmetic
};

}  // namespace hinge::detail
