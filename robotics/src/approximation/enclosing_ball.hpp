// SPDX-License-Identifier: BSD-3-Clause
// Balls and circles around points: in the plane the smallest, in space nearly.
#pragma once

#include <array>
#include <span>

#include "hinge/core/vec3.hpp"

namespace hinge::robotics {

struct Ball {
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;
};

/// Larger than the smallest by some percent at most; points outside by rounding at most. Points: at least one.
Ball enclosing_ball(std::span<const Vec3> points);

struct Circle {
  double x = 0.0, y = 0.0;
  double radius = 0.0;
};

/// The smallest, up to rounding. Points: at least one.
Circle smallest_circle(std::span<const std::array<double, 2>> points);

/// Large enough for each point to be at least enclosing_margin inside, whatever the rounding here.
double enclosing_radius(double farthest_squared);

}  // namespace hinge::robotics
