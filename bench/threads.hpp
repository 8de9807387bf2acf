// SPDX-License-Identifier: BSD-3-Clause
// One and two threads: how many conformations a second they answer.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hinge/engine/simd.hpp"
#include "results.hpp"
#include "scene.hpp"
#include "timing.hpp"

namespace hinge::bench {

/// Conformations per second of `threads` threads, each with its own hierarchy: yes/no queries from torsion angles.
inline double throughput(Scene& scene, Sampling sampling, int threads) {
  constexpr double seconds = 0.5;
  std::vector<std::vector<double>> q;
  for (std::uint64_t k = 0; k < 64; ++k) q.push_back(scene.configuration(sampling, k));
  std::atomic<long> total{0};
  const auto work = [&] {
    auto hierarchy = scene.make<Simd>();
    const auto start = Clock::now();
    long count = 0, colliding = 0;
    for (; seconds_since(start) < seconds; ++count) {
      hierarchy.update(q[static_cast<std::size_t>(count) % q.size()]);
      colliding += hierarchy.self_collides() ? 1 : 0;
    }
    total += colliding <= count ? count : 0;  // uses the answers, so that the compiler cannot remove the queries
  };
  std::vector<std::thread> running;
  for (int t = 0; t < threads; ++t) running.emplace_back(work);
  for (std::thread& t : running) t.join();
  return static_cast<double>(total) / seconds;
}

/// Prints and adds how many times as many conformations two threads answer, of random and near-free ones.
inline void run_threads(Results& results, const Json& setup, Scene& scene) {
  for (const Sampling sampling : {Sampling::random, Sampling::near_free}) {
    double one = 0.0, two = 0.0;  // the best of three, in turns
    for (int round = 0; round < 3; ++round) {
      one = std::max(one, throughput(scene, sampling, 1));
      two = std::max(two, throughput(scene, sampling, 2));
    }
    results.print("threads any " + std::string(name(sampling)) + ' ' + std::to_string(scene.dof_count()) + "dof",
                  two / one);
    Json row = {{"kind", "threads"}};
    row.update(setup);
    row.update({{"sampling", name(sampling)}, {"one", one}, {"two", two}});
    results.add(std::move(row));
  }
}

}  // namespace hinge::bench
