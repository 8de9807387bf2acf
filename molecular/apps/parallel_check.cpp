// SPDX-License-Identifier: BSD-3-Clause
// Workers take the next sample from a shared counter and write to its own place.
#include "parallel_check.hpp"

#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>

namespace biocd {

std::vector<Sample> check_samples(std::vector<hinge::molecular::Checker>& workers,
                                  const hinge::molecular::Sampling& sampling, const hinge::molecular::Mode& mode,
                                  std::uint64_t first, std::uint64_t count, bool keep_positions) {
  std::vector<Sample> samples(static_cast<std::size_t>(count));
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> failures(workers.size());
  const auto work = [&](std::size_t w) {
    try {
      for (std::size_t k = next++; k < samples.size(); k = next++) {
        const auto q = hinge::molecular::sample_configuration(sampling, first + k, workers[w].dof_count());
        samples[k].verdict = workers[w].check(q, mode);
        if (keep_positions) samples[k].positions = workers[w].positions();
      }
    } catch (...) {
      failures[w] = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t w = 1; w < workers.size(); ++w) threads.emplace_back(work, w);
  work(0);
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
  return samples;
}

}  // namespace biocd
