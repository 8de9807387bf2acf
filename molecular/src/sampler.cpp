// SPDX-License-Identifier: BSD-3-Clause
// Random conformations from the counter-based stream.
#include "hinge/molecular/sampler.hpp"

#include <numbers>

namespace hinge::molecular {

std::vector<double> draw_configuration(const Sampling& sampling, SampleStream& stream, std::size_t dof_count) {
  std::vector<double> q(dof_count);
  for (double& value : q)
    value = sampling.sigma ? *sampling.sigma * stream.normal() : std::numbers::pi * (1.0 - 2.0 * stream.uniform());
  return q;
}

std::vector<double> sample_configuration(const Sampling& sampling, std::uint64_t index, std::size_t dof_count) {
  SampleStream stream(sampling.seed, index);
  return draw_configuration(sampling, stream, dof_count);
}

}  // namespace hinge::molecular
