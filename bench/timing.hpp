// SPDX-License-Identifier: BSD-3-Clause
// Timing: all contestants interleaved on the same conformations, with a comparison of their answers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "contestant.hpp"
#include "hinge_tools/clock.hpp"
#include "scene.hpp"

namespace hinge::bench {

using tool::Clock;
using tool::seconds_since;

/// Time of one call in microseconds.
template <class Work>
double microseconds(const Work& work) {
  const auto start = Clock::now();
  work();
  return 1e6 * seconds_since(start);
}

/// The best of three times counts per conformation, because a single pre-emption distorts a mean.
inline constexpr int repetitions = 3;

/// Times of one contestant in one cell of the table (set-up, sampling, query).
struct Series {
  std::string name;
  double us = 0.0;       ///< mean of the best times
  double simd_us = 0.0;  ///< mean of the first contestant over the same conformations
  int conformations = 0;
  double spent = 0.0;  ///< seconds, including preparation

  double ratio() const { return us / simd_us; }
};

/// Times of all contestants for one set-up, sampling and query.
struct Cell {
  std::vector<Series> series;  ///< the first contestant comes first; contestants without an answer are missing
  int conformations = 0;
  int colliding = 0;    ///< number of conformations that collide
  int differences = 0;  ///< answers that differ from the first contestant's
  double pairs = 0.0;   ///< mean length of the first contestant's lists
};

/// Limits on the time and size of a cell.
struct Limits {
  double seconds = 2.0;     ///< for the cell; divided evenly, so slow contestants get fewer conformations
  int conformations = 100;  ///< upper limit
};

/// Contestants take turns on each conformation of a block, and a block is repeated `repetitions` times. So no
/// contestant is asked twice in a row, and each repetition includes the update from another configuration.
class Measurement {
 public:
  Measurement(Scene& scene, std::vector<Contestant>& contestants, Query query, Sampling sampling)
      : scene_(scene), contestants_(contestants), query_(query), sampling_(sampling) {}

  Cell run(const Limits& limits) {
    Cell cell;
    std::vector<std::size_t> active;
    for (std::size_t c = 0; c < contestants_.size(); ++c) {
      cell.series.push_back({contestants_[c].name, 0.0, 0.0, 0, 0.0});
      if (answers(contestants_[c], query_, sampling_)) active.push_back(c);
    }
    const double share = limits.seconds / static_cast<double>(active.size());
    int block = 2;  // two conformations show the cost of a contestant
    for (int first = 0; first < limits.conformations && active.size() > 1; first += block, block = 4) {
      run_block(first, first == 0 ? 2 : 4, active, cell);
      std::erase_if(active, [&](std::size_t c) { return c != 0 && cell.series[c].spent > share; });
    }
    for (Series& s : cell.series) {
      s.us /= s.conformations;
      s.simd_us /= s.conformations;
    }
    std::erase_if(cell.series, [](const Series& s) { return s.conformations == 0; });
    cell.pairs /= std::max(1, cell.conformations);
    return cell;
  }

 private:
  void run_block(int first, int count, const std::vector<std::size_t>& active, Cell& cell) {
    const auto n = static_cast<std::size_t>(count);
    std::vector<Conformation> conformations;
    std::vector<bool> collides;
    for (int k = first; k < first + count; ++k) {
      conformations.push_back(scene_.conformation(sampling_, static_cast<std::uint64_t>(k)));
      Answer answer;
      contestants_[0].prepare(conformations.back());
      contestants_[0].ask(Query::any, answer);
      collides.push_back(answer.collides);
    }
    const auto unasked = std::numeric_limits<double>::infinity();
    std::vector<std::vector<double>> best(contestants_.size(), std::vector<double>(n, unasked));
    std::vector<Answer> given(contestants_.size());  // lists keep their memory
    std::vector<double> listed(n, 0.0);
    for (int repetition = 0; repetition < repetitions; ++repetition)
      for (std::size_t k = 0; k < n; ++k) {
        std::vector<std::size_t> asked;
        for (std::size_t turn = 0; turn < active.size(); ++turn) {
          const std::size_t c = active[(turn + k) % active.size()];
          if (contestants_[c].name == "fcl" && query_ == Query::closest && collides[k]) continue;
          const auto start = Clock::now();
          contestants_[c].prepare(conformations[k]);
          given[c].clear();
          best[c][k] = std::min(best[c][k], microseconds([&] { contestants_[c].ask(query_, given[c]); }));
          cell.series[c].spent += seconds_since(start);
          asked.push_back(c);
        }
        if (repetition == 0) cell.differences += differences(given, asked);
        listed[k] = static_cast<double>(given[0].pairs.size());
      }
    for (std::size_t k = 0; k < n; ++k) {
      ++cell.conformations;
      cell.pairs += listed[k];
      cell.colliding += collides[k] ? 1 : 0;
      for (std::size_t c = 0; c < contestants_.size(); ++c) {
        if (best[c][k] == unasked) continue;
        cell.series[c].us += best[c][k];
        cell.series[c].simd_us += best[0][k];
        ++cell.series[c].conformations;
      }
    }
  }

  int differences(const std::vector<Answer>& given, const std::vector<std::size_t>& asked) const {
    int count = 0;
    for (const std::size_t c : asked) count += same(given[0], given[c], gap_tolerance(contestants_[c])) ? 0 : 1;
    return count;
  }

  Scene& scene_;
  std::vector<Contestant>& contestants_;
  Query query_;
  Sampling sampling_;
};

}  // namespace hinge::bench
