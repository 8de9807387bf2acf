// SPDX-License-Identifier: BSD-3-Clause
// A small capsule, or sphere, around points.
#pragma once

#include <span>

#include "hinge/robotics/robot_description.hpp"

namespace hinge::robotics {

/// A capsule of small volume; a sphere where a segment would not make it smaller. Not the smallest there is, but no
/// direction near its own gives a smaller one. Every point is at least enclosing_margin inside. Points: at least one,
/// finite, m.
PlacedShape fit_capsule(std::span<const Vec3> points);

}  // namespace hinge::robotics
