// SPDX-License-Identifier: BSD-3-Clause
// draw: one conformation of `biocd sample`, or a block of them, with verdicts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/closed_sampler.hpp"
#include "hinge/molecular/free_sampler.hpp"
#include "hinge/molecular/sampler.hpp"
#include "options.hpp"
#include "report.hpp"
#include "scene.hpp"

namespace biocd {

/// A conformation that was drawn.
struct Sample {
  hinge::molecular::Verdict verdict;
  std::vector<hinge::Vec3> positions;  // empty unless --out takes them
  bool found = true;                   // false: no start closed, or none gave a free conformation
  bool stopped = false;                // the time was over
  std::uint64_t unclosed = 0, refused = 0;
  std::vector<hinge::Hit> blockers{};  // see FreeSample
  Placements placements{};
  std::string pairs{};             // JSON; empty for other outputs, and for modes without a list
  std::vector<double> torsions{};  // values of the selected DOF, as torsion_values gives them; empty unless wanted
};

/// State of one thread.
struct Worker {
  hinge::molecular::Checker checker;
  std::optional<hinge::molecular::ClosedSampler> closed;
  std::optional<hinge::molecular::FreeSampler> free;
  bool wants_torsions = false;  // in every sample
};

/// Sets the outputs that depend on q only.
void describe(Sample& sample, const Worker& worker, const Job& job, const std::vector<double>& q);

/// Draws conformation k and tests it. stop: returns true to give up. Any number of threads may call this, with a worker
/// each.
Sample draw(Worker& worker, const Job& job, const hinge::molecular::Sampling& sampling, std::uint64_t k,
            const hinge::Mode& mode, const std::function<bool()>& stop = {});

/// Conformations that one call of check_batch() tests.
inline constexpr std::size_t block_size = 16;

/// Draws conformations first .. last - 1 and tests them together. takes(collides): positions are wanted.
template <class Takes>
std::vector<Sample> draw_block(Worker& worker, const Job& job, const hinge::molecular::Sampling& sampling,
                               std::uint64_t first, std::uint64_t last, const Takes& takes) {
  std::vector<Sample> samples;
  samples.reserve(static_cast<std::size_t>(last - first));
  std::vector<double> all;
  all.reserve(samples.capacity() * job.checker.dof_count());
  for (std::uint64_t k = first; k < last; ++k) {
    const std::vector<double> q =
        hinge::molecular::sample_configuration(sampling, k, *job.molecule, job.checker.selection(), job.ranges);
    all.insert(all.end(), q.begin(), q.end());
    describe(samples.emplace_back(), worker, job, q);
  }
  const std::vector<std::uint8_t> verdicts = worker.checker.check_batch(all);
  for (std::size_t k = 0; k < verdicts.size(); ++k) {
    samples[k].verdict.collides = verdicts[k] != 0;
    if (!takes(verdicts[k] != 0)) continue;
    const std::size_t dof = all.size() / verdicts.size();
    worker.checker.check(std::span(all).subspan(k * dof, dof), hinge::Mode::parse("any"));
    samples[k].positions = worker.checker.positions();
  }
  return samples;
}

}  // namespace biocd
