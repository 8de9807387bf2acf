// SPDX-License-Identifier: BSD-3-Clause
// Workers take the next index from a shared counter.
#include "parallel_check.hpp"

#include <atomic>
#include <exception>
#include <thread>

namespace biocd {

void check_parallel(std::vector<hinge::molecular::Checker>& workers, std::size_t count,
                    const std::function<void(hinge::molecular::Checker&, std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> failures(workers.size());
  const auto run = [&](std::size_t w) {
    try {
      for (std::size_t k = next++; k < count; k = next++) work(workers[w], k);
    } catch (...) {
      failures[w] = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t w = 1; w < workers.size(); ++w) threads.emplace_back(run, w);
  run(0);
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace biocd
