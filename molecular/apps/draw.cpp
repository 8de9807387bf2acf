// SPDX-License-Identifier: BSD-3-Clause
// Implements draw.
#include "draw.hpp"

#include <utility>

namespace biocd {

using namespace hinge::molecular;

void describe(Sample& sample, const Worker& worker, const Job& job, const std::vector<double>& q) {
  sample.placements = placements_of(job, q);
  if (worker.wants_torsions) sample.torsions = torsion_values(job, q);
}

Sample draw(Worker& worker, const Job& job, const Sampling& sampling, std::uint64_t k, const Mode& mode,
            const std::function<bool()>& stop) {
  std::vector<double> q;
  Sample sample;
  if (worker.free) {
    FreeSample found = worker.free->sample(k, stop);
    sample.found = found.found();
    q = std::move(found.q);
    sample.unclosed = found.unclosed;
    sample.refused = found.dead_ends;
    sample.blockers = std::move(found.blockers);
    sample.stopped = found.stopped;
  } else if (worker.closed) {
    ClosedSample closed = worker.closed->sample(k);
    sample.found = closed.found();
    q = std::move(closed.q);
    sample.unclosed = closed.unclosed;
  } else {
    q = sample_configuration(sampling, k, *job.molecule, job.checker.selection(), job.ranges);
  }
  if (!sample.found) return sample;
  describe(sample, worker, job, q);
  sample.verdict = worker.checker.check(q, mode);
  return sample;
}

}  // namespace biocd
