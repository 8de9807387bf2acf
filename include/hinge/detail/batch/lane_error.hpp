// SPDX-License-Identifier: BSD-3-Clause
// LaneError: how far a place computed in float lanes may be from the one that verdicts are about.
#pragma once

#include <algorithm>

namespace hinge::detail {

/// What one joint contributes, model length unit.
struct JointLengths {
  double offset = 0.0;  ///< from the parent's lane frame to the own one, slid distance included
  double detour = 0.0;  ///< sum of the lengths that the double computation adds up on its way between them
};

/// Bounds for the lane frame of one rigid group, model length unit; docs/explanation/sphere_batch.md derives each step.
class LaneError {
 public:
  /// The world's frame, moved by `shift` from the world's origin.
  explicit LaneError(double shift) noexcept : shift_(shift) {}

  /// Of a group that hangs on this one.
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

  /// Of a point at distance `length` from the lane frame's origin, in double `detour` away from the group's.
  double of_point(double length, double detour) const noexcept {
    const double in_float =
        (rotation_ + 10 * u * (stretch_ + rotation_)) * length + translation_ + 4 * u * reach(length);
    const double in_double =
        exact_translation_ + (exact_rotation_ + 64 * v) * detour + 64 * v * (shift_ + reach(length));
    return in_float + in_double;
  }
  /// How far from the lanes' origin such a point can be.
  double reach(double length) const noexcept { return reach_ + stretch_ * length; }
  /// Distances within a group grow by this factor at most: joint origins need be rigid within rigid_tolerance only.
  double stretch() const noexcept { return stretch_; }

  static constexpr double u = 0x1p-24;  ///< relative error of one rounding to float
  static constexpr double v = 0x1p-53;  ///< the same to double

 private:
  // Per joint: terms of second order (25 u) and origins that are rigid within 1e-9 only; 32 u is above the sum.
  static constexpr double slack = 1.0 + 32 * u;

  double shift_;
  double stretch_ = 1.0;                                   // bound of the norm of the exact matrix
  double reach_ = 0.0;                                     // of the lane frame's origin from the lanes' origin
  double rotation_ = 0.0, translation_ = 0.0;              // lanes against real arithmetic
  double exact_rotation_ = 0.0, exact_translation_ = 0.0;  // double against real arithmetic
};

}  // namespace hinge::detail
