// SPDX-License-Identifier: BSD-3-Clause
// RadiusSum: a threshold stored as three terms, so that tests can use the exact sum.
#pragma once

namespace hinge {

/// The radii of two primitives and a clearance (model length unit), each >= 0. The sum of the three doubles would be
/// rounded, so exact tests take the terms.
struct RadiusSum {
  double first = 0.0;      ///< radius of the first primitive
  double second = 0.0;     ///< radius of the second primitive
  double clearance = 0.0;  ///< additional distance

  /// Returns the sum, with two roundings.
  operator double() const noexcept { return first + second + clearance; }
  /// Returns the sum with `more` added to the clearance (one rounding).
  friend RadiusSum operator+(const RadiusSum& sum, double more) noexcept {
    return {sum.first, sum.second, sum.clearance + more};
  }
  /// Returns true when touching closed solids collide. This is the case when the clearance is zero. With a positive
  /// clearance the surface distance must be below it.
  bool counts_touching() const noexcept { return !(clearance > 0.0); }
};

}  // namespace hinge
