// SPDX-License-Identifier: BSD-3-Clause
// Many samples at once: one checker per worker, results in index order.
#pragma once

#include <cstdint>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/sampler.hpp"

namespace biocd {

struct Sample {
  hinge::molecular::Verdict verdict;
  std::vector<hinge::Vec3> positions;  ///< angstrom; only when they were asked for
};

/// Samples first ... first + count - 1. The result does not depend on the number of workers. Whatever a worker throws
/// is thrown again here.
std::vector<Sample> check_samples(std::vector<hinge::molecular::Checker>& workers,
                                  const hinge::molecular::Sampling& sampling, const hinge::molecular::Mode& mode,
                                  std::uint64_t first, std::uint64_t count, bool keep_positions);

}  // namespace biocd
