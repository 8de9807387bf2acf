// SPDX-License-Identifier: BSD-3-Clause
// Random conformations of a selection: each a pure function of (seed, index).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "hinge/core/philox.hpp"

namespace hinge::molecular {

/// Uniform over the full turn, or Gaussian about the reference.
struct Sampling {
  std::uint64_t seed = 0;
  std::optional<double> sigma;  ///< rad; none: full range (-pi, pi]
};

/// The next configuration of a stream: turns from the reference (rad), one per DOF.
std::vector<double> draw_configuration(const Sampling& sampling, SampleStream& stream, std::size_t dof_count);

/// Turns from the reference (rad) of sample `index`, one per DOF, in DOF order.
std::vector<double> sample_configuration(const Sampling& sampling, std::uint64_t index, std::size_t dof_count);

}  // namespace hinge::molecular
