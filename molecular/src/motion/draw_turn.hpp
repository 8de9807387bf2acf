// SPDX-License-Identifier: BSD-3-Clause
// draw_turn: one torsion by itself.
#pragma once

#include <numbers>
#include <optional>

#include "hinge/core/philox.hpp"

namespace hinge::molecular {

/// Returns the rotation in (-pi, pi] of a number in [0, 1).
inline double turn_of(double uniform) { return std::numbers::pi * (1.0 - 2.0 * uniform); }

/// Returns a rotation relative to the reference, rad: Gaussian with standard deviation sigma, or uniform in (-pi, pi].
inline double draw_turn(const std::optional<double>& sigma, SampleStream& stream) {
  return sigma ? *sigma * stream.normal() : turn_of(stream.uniform());
}

}  // namespace hinge::molecular
