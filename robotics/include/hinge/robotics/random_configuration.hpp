// SPDX-License-Identifier: BSD-3-Clause
// random_configuration: random values of a robot's independent joints within their limits.
#pragma once

#include <cstdint>
#include <span>

#include "hinge/core/api.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// Fills `q` with configuration `index` of the seed, uniform within the joint limits (rad or m), one value per
/// independent joint. It depends only on (robot, seed, index). q must have independent_joints().size() values.
HINGE_API void random_configuration(const Robot& robot, std::uint64_t seed, std::uint64_t index,
                                    std::span<double> q) noexcept;

}  // namespace hinge::robotics
