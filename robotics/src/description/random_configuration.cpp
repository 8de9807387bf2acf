// SPDX-License-Identifier: BSD-3-Clause
// Implements random_configuration.
#include "hinge/robotics/random_configuration.hpp"

#include <algorithm>
#include <cstddef>

#include "hinge/core/philox.hpp"

namespace hinge::robotics {

void random_configuration(const Robot& robot, std::uint64_t seed, std::uint64_t index, std::span<double> q) noexcept {
  SampleStream stream(seed, index);
  for (std::size_t j = 0; j < q.size(); ++j)
    // Rounding may exceed the limit.
    q[j] = std::min(robot.lower()[j] + stream.uniform() * (robot.upper()[j] - robot.lower()[j]), robot.upper()[j]);
}

}  // namespace hinge::robotics
