// SPDX-License-Identifier: BSD-3-Clause
// Balls and circles around points: the smallest circle, and an almost smallest ball. Lengths in m.
#pragma once

#include <array>
#include <span>

#include "hinge/core/vec3.hpp"

namespace hinge::robotics {

/// A ball, m.
struct Ball {
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;
};

/// Returns a ball at most a few percent larger than the smallest one. Points may be outside by rounding. points: at
/// least one.
Ball enclosing_ball(std::span<const Vec3> points);

/// A circle in a plane, m.
struct Circle {
  double x = 0.0, y = 0.0;
  double radius = 0.0;
};

/// Returns the smallest circle, up to rounding. points: at least one.
Circle smallest_circle(std::span<const std::array<double, 2>> points);

/// Returns a radius such that every point is at least enclosing_margin inside, allowing for rounding. farthest_squared:
/// squared distance (m^2) of the farthest point from the centre.
double enclosing_radius(double farthest_squared);

}  // namespace hinge::robotics
