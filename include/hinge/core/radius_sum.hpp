// SPDX-License-Identifier: BSD-3-Clause
// RadiusSum: a threshold kept as its terms, so that a verdict can be about the exact sum.
#pragma once

namespace hinge {

/// The radii of two primitives and a clearance (model length unit), each >= 0. Adding them as doubles rounds; exact
/// tests take the three terms instead.
struct RadiusSum {
  double first = 0.0;
  double second = 0.0;
  double clearance = 0.0;

  /// The sum, rounded twice.
  operator double() const noexcept { return first + second + clearance; }
  friend RadiusSum operator+(const RadiusSum& sum, double more) noexcept {
    return {sum.first, sum.second, sum.clearance + more};
  }
  /// Closed solids that touch collide when there is no clearance; with one they must be nearer than it.
  bool counts_touching() const noexcept { return !(clearance > 0.0); }
};

}  // namespace hinge
