// SPDX-License-Identifier: BSD-3-Clause
// Timing of robot queries: contestants take turns on blocks of postures (warm) or on single postures (cold).
#pragma once

#include <ctime>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "robots/robot_contestant.hpp"

namespace hinge::bench {

/// CPU time of this thread in seconds.
inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline constexpr int robot_rounds = 3;
inline constexpr double warming_seconds = 1e-3;

/// Times of one contestant for one query on one robot. The first contestant is Hinge.
struct RobotSeries {
  std::string name;
  std::size_t postures = 0;
  double us = 0.0;        ///< best time of the rounds, mean over the postures
  double hinge_us = 0.0;  ///< time of the first contestant over the same postures
  std::vector<RobotAnswer> answers{};

  double ratio() const { return us / hinge_us; }
};

/// Times warm queries. Contestants share `seconds` evenly, so slow ones get fewer postures. Each round goes through
/// all postures, so that no posture repeats directly. A contestant answers a block of postures in a row: a hundred,
/// or as many as the slowest can afford; this is the meaning of warm. The clock is read once per block, because
/// reading it takes as long as a short query.
inline std::vector<RobotSeries> time_robot(std::span<const RobotContestant> contestants, RobotQuery query,
                                           std::size_t postures, double seconds) {
  const auto fewest = [](std::size_t n) { return std::min<std::size_t>(n, 2); };
  const double share = seconds / static_cast<double>(contestants.size());
  std::vector<RobotSeries> series;
  std::size_t block = 100;
  for (const RobotContestant& c : contestants) {
    RobotSeries& s = series.emplace_back(RobotSeries{c.name});
    s.answers.resize(postures);
    c.ask(0, query, s.answers[0]);  // includes allocations of the first call
    const double start = thread_seconds();
    c.ask(fewest(postures) - 1, query, s.answers[fewest(postures) - 1]);
    const double cost = std::max(thread_seconds() - start, 1e-7);
    const double affordable = share / (robot_rounds * cost);
    s.postures = affordable > static_cast<double>(postures)
                     ? postures
                     : std::max(fewest(postures), static_cast<std::size_t>(affordable));
    block = std::min(block, s.postures);
  }
  for (RobotSeries& s : series) s.postures = s.postures / block * block;
  const std::size_t blocks = series.front().postures / block;
  for (RobotSeries& s : series) s.postures = std::min(s.postures, blocks * block);

  std::vector<std::vector<double>> best(series.size(),
                                        std::vector<double>(blocks, std::numeric_limits<double>::infinity()));
  for (int round = 0; round < robot_rounds; ++round)
    for (std::size_t b = 0; b < blocks; ++b)
      for (std::size_t turn = 0; turn < series.size(); ++turn) {
        const std::size_t c = (turn + b) % series.size();
        if (b * block >= series[c].postures) continue;
        RobotAnswer ignored;
        const double warm = thread_seconds() + warming_seconds;
        for (std::size_t p = b * block + block; thread_seconds() < warm; ++p)  // postures of the next block
          contestants[c].ask(p % series[c].postures, query, ignored);
        const double start = thread_seconds();
        for (std::size_t p = b * block; p < (b + 1) * block; ++p) contestants[c].ask(p, query, series[c].answers[p]);
        best[c][b] = std::min(best[c][b], thread_seconds() - start);
      }
  for (std::size_t c = 0; c < series.size(); ++c) {
    const std::size_t own = series[c].postures / block;
    for (std::size_t b = 0; b < own; ++b) {
      series[c].us += 1e6 * best[c][b] / static_cast<double>(series[c].postures);
      series[c].hinge_us += 1e6 * best[0][b] / static_cast<double>(series[c].postures);
    }
  }
  return series;
}

/// Reads more memory than a second-level cache holds.
class CacheFlush {
 public:
  std::uint64_t operator()() noexcept {
    for (std::size_t k = 0; k < words_.size(); k += 8) sum_ += words_[k]++;
    return sum_;
  }

 private:
  static constexpr std::size_t bytes = std::size_t{16} << 20;
  std::vector<std::uint64_t> words_ = std::vector<std::uint64_t>(bytes / 8, 1);
  std::uint64_t sum_ = 0;
};

/// Microseconds of each contestant with its data out of the second-level cache: best of the rounds, mean over
/// postures.
inline std::vector<double> time_cold(std::span<const RobotContestant> contestants, RobotQuery query,
                                     std::size_t postures) {
  using Steady = std::chrono::steady_clock;  // 20 ns per reading; the thread's CPU clock takes twenty times as long
  CacheFlush flush;
  std::vector<double> means(contestants.size(), 0.0);
  std::vector<std::vector<double>> best(contestants.size(),
                                        std::vector<double>(postures, std::numeric_limits<double>::infinity()));
  RobotAnswer answer;
  for (int round = 0; round < robot_rounds; ++round)
    for (std::size_t p = 0; p < postures; ++p)
      for (std::size_t c = 0; c < contestants.size(); ++c) {
        flush();
        const auto start = Steady::now();
        contestants[c].ask(p, query, answer);
        best[c][p] = std::min(best[c][p], std::chrono::duration<double, std::micro>(Steady::now() - start).count());
      }
  for (std::size_t c = 0; c < contestants.size(); ++c)
    for (const double us : best[c]) means[c] += us / static_cast<double>(postures);
  return means;
}

}  // namespace hinge::bench
