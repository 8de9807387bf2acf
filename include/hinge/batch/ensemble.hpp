// SPDX-License-Identifier: BSD-3-Clause
// Ensemble: runs many configurations on many threads, with results in index order and bounded memory.
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/detail/batch/configuration_count.hpp"
#include "hinge/hierarchy.hpp"

namespace hinge {

/// Owns one worker per thread: a copy of a Hierarchy, or of any object that holds one. Copies share constant data, so a
/// worker costs the scratch memory of one engine. Requires linking to hinge::ensemble.
template <std::copyable Worker>
class Ensemble {
 public:
  /// Copies `prototype` once per thread. Throws ModelError if threads is 0.
  Ensemble(const Worker& prototype, unsigned threads) : arena_(checked(threads)), workers_(prototype) {}

  /// Calls work(worker, k) -> result once for every k < count, on any thread. Calls take(k, result) in the order of k,
  /// by one thread at a time: its calls do not depend on the number of threads. At most 4 chunks of results per thread
  /// exist at a time, of at most `longest` results each; choose fewer if a result is large or slow. The first exception
  /// of work or take ends the run and is rethrown.
  template <class Work, class Take>
  void run(std::size_t count, const Work& work, const Take& take, std::size_t longest = 256) {
    using Result = std::remove_cvref_t<std::invoke_result_t<const Work&, Worker&, std::size_t>>;
    struct Chunk {
      std::size_t first = 0;
      std::vector<Result> results;
    };
    const auto threads = static_cast<std::size_t>(arena_.max_concurrency());
    // Long chunks make the hand-over cheap compared to queries of a microsecond; short ones balance the load.
    const std::size_t length = std::clamp<std::size_t>(count / (8 * threads), 1, longest);
    // One chunk per token of the pipeline; chunks end in order. They are owned here because a pipeline loses its own
    // objects when an exception ends it.
    std::vector<Chunk> chunks(4 * threads);
    std::size_t next = 0;
    const auto hand_out = [&](tbb::flow_control& flow) -> std::size_t {
      if (next >= count) {
        flow.stop();
        return count;
      }
      return std::exchange(next, next + length);
    };
    const auto process = [&](std::size_t first) {
      Worker& worker = workers_.local();
      Chunk& chunk = chunks[first / length % chunks.size()];
      chunk.first = first;
      const std::size_t end = std::min(first + length, count);
      chunk.results.reserve(end - first);
      for (std::size_t k = first; k < end; ++k) chunk.results.push_back(work(worker, k));
      return &chunk;
    };
    const auto hand_over = [&](Chunk* chunk) {
      for (std::size_t k = 0; k < chunk->results.size(); ++k) take(chunk->first + k, std::move(chunk->results[k]));
      chunk->results.clear();
    };
    // Allow more threads than cores; otherwise TBB warns on standard error and uses fewer.
    constexpr auto most = tbb::global_control::max_allowed_parallelism;
    std::optional<tbb::global_control> allowed;
    if (threads > tbb::global_control::active_value(most)) allowed.emplace(most, threads);
    arena_.execute([&] {
      tbb::parallel_pipeline(chunks.size(),
                             tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, hand_out) &
                                 tbb::make_filter<std::size_t, Chunk*>(tbb::filter_mode::parallel, process) &
                                 tbb::make_filter<Chunk*, void>(tbb::filter_mode::serial_in_order, hand_over));
    });
  }

 private:
  static int checked(unsigned threads) {
    if (threads == 0) throw ModelError("0 threads, expected at least one");
    return static_cast<int>(threads);
  }

  tbb::task_arena arena_;
  tbb::enumerable_thread_specific<Worker> workers_;
};

/// Returns one verdict per configuration: 1 if it collides, otherwise 0. configurations: one after the other,
/// hierarchy.dof_count() values each (rad or model length unit). Throws ConfigurationError if their number is not a
/// multiple of dof_count(), or if update() throws.
template <class H>
std::vector<std::uint8_t> self_collides(const H& hierarchy, std::span<const double> configurations, unsigned threads) {
  const std::size_t dof = hierarchy.dof_count();
  const std::size_t count = detail::configuration_count(configurations, dof);
  std::vector<std::uint8_t> verdicts;
  verdicts.reserve(count);
  Ensemble<H>(hierarchy, threads)
      .run(
          count,
          [&](H& own, std::size_t k) -> std::uint8_t {
            own.update(configurations.subspan(k * dof, dof));
            return own.self_collides() ? 1 : 0;
          },
          [&](std::size_t, std::uint8_t verdict) { verdicts.push_back(verdict); });
  return verdicts;
}

}  // namespace hinge
