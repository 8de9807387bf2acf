// SPDX-License-Identifier: BSD-3-Clause
// Random conformations from the counter-based stream.
#include "hinge/molecular/sampler.hpp"

#include <numbers>

#include "hinge/core/philox.hpp"

namespace hinge::molecular {

std::vector<double> sample_configuration(const Sampling& sampling, std::uint64_t index, std::size_t dof_count) {
  SampleStream stream(sampling.seed, index);
  std::vector<double> q(dof_count);
  for (double& value : q)
    value = sampling.sigma ? *sampling.sigma * stream.normal() : std::numbers::pi * (1.0 - 2.0 * stream.uniform());
  return q;
}

}  // namespace hinge::molecular
