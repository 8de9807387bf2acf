// SPDX-License-Identifier: BSD-3-Clause
// Reference answers: every pair in double, all modes in one pass, no code shared with engines or peers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "contestant.hpp"
#include "peers/peer.hpp"

namespace hinge::bench {

/// Brute force in double over one input.
class Reference {
 public:
  explicit Reference(std::shared_ptr<const PeerInput> input)
      : input_(std::move(input)),
        largest_(input_->table.empty() ? 0.0 : *std::max_element(input_->table.begin(), input_->table.end())),
        x_(input_->n),
        y_(input_->n),
        z_(input_->n),
        squared_(input_->n) {}

  /// Answers in the order of all_queries. xyz: coordinates in angstrom, 3 per atom.
  std::vector<Answer> ask(std::span<const double> xyz) {
    std::vector<Answer> answers(std::size(all_queries));
    const auto answer = [&](Query query) -> Answer& { return answers[static_cast<std::size_t>(query)]; };
    Answer &all = answer(Query::all), &within = answer(Query::within), &closest = answer(Query::closest);
    const std::size_t n = input_->n;
    for (std::size_t i = 0; i < n; ++i) {
      x_[i] = xyz[3 * i];
      y_[i] = xyz[3 * i + 1];
      z_[i] = xyz[3 * i + 2];
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double xi = x_[i], yi = y_[i], zi = z_[i];
      for (std::size_t j = i + 1; j < n; ++j) {
        const double dx = xi - x_[j], dy = yi - y_[j], dz = zi - z_[j];
        squared_[j] = dx * dx + dy * dy + dz * dz;
      }
      for (std::size_t j = i + 1; j < n; ++j) {
        const double squared = squared_[j];
        // Skips pairs beyond both the margin and the closest pair so far; 1e-9 (relative) covers the rounding of a
        // root.
        const double reach = largest_ + std::max(margin, closest.gap);
        if (squared > reach * reach * (1 + 1e-9)) continue;
        const auto a = static_cast<std::uint32_t>(i), b = static_cast<std::uint32_t>(j);
        const double m = input_->table[input_->type[i] * input_->type_count + input_->type[j]];
        if (!input_->admits(a, b)) continue;
        closest.gap = std::min(closest.gap, std::sqrt(squared) - m);
        const Hit hit{id<PrimitiveId>(i), id<PrimitiveId>(j), std::sqrt(squared), m};
        if (squared < (m + margin) * (m + margin)) within.pairs.push_back(hit);
        if (squared < m * m) all.pairs.push_back(hit);
      }
    }
    answer(Query::any).collides = !all.pairs.empty();
    answer(Query::counted).count = all.pairs.size();
    return answers;
  }

 private:
  std::shared_ptr<const PeerInput> input_;
  double largest_;
  std::vector<double> x_, y_, z_, squared_;
};

/// Number of modes whose answer differs from the reference at one conformation. Modes are asked in turn, starting
/// with number `first`: one mode's cached data must not change the next answer.
inline int count_differences(Contestant& contestant, const Conformation& conformation,
                             const std::vector<Answer>& expected, std::size_t first) {
  int differences = 0;
  for (std::size_t turn = 0; turn < expected.size(); ++turn) {
    const std::size_t mode = (first + turn) % expected.size();
    Answer answer;
    contestant.prepare(conformation);
    contestant.ask(all_queries[mode], answer);
    differences += same(answer, expected[mode]) ? 0 : 1;
  }
  return differences;
}

}  // namespace hinge::bench
