// SPDX-License-Identifier: BSD-3-Clause
// fit_capsule: a small capsule or sphere around points.
#pragma once

#include <span>

#include "hinge/robotics/robot_description.hpp"

namespace hinge::robotics {

/// Returns a capsule of small volume, or a sphere if a capsule is not smaller. A local minimum over the direction of
/// the axis. Every point is at least enclosing_margin inside. points: at least one, finite, m.
PlacedShape fit_capsule(std::span<const Vec3> points);

}  // namespace hinge::robotics
