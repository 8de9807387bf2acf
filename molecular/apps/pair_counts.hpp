// SPDX-License-Identifier: BSD-3-Clause
// PairCounts: counts pairs of atoms or residues, and prints the most frequent ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "hinge_tools/frequent_keys.hpp"
#include "report.hpp"

namespace biocd {

/// A pair of atoms or residues, by index and name, and how often it was counted.
struct PairCount {
  std::uint32_t i = 0, j = 0;
  std::string label_i, label_j;
  std::uint64_t count = 0;
};

/// Counts in bounded memory (FrequentKeys). Names come from a function, or from the JSON objects that were added.
class PairCounts {
 public:
  using Label = std::function<std::string(std::uint32_t)>;

  /// Sets the names of the pairs that are added by index.
  void set_labels(Label label) { label_ = std::move(label); }
  /// Counts the pair (i, j).
  void add(std::uint32_t i, std::uint32_t j, std::uint64_t times = 1) {
    counts_.add((std::uint64_t{i} << 32U) + j, times);
  }
  /// Counts a pair with the keys i, j, label_i and label_j.
  void add(const Json& pair, std::uint64_t times = 1);

  /// Returns the most frequent pairs, the most frequent one first.
  std::vector<PairCount> top(std::size_t most) const;
  /// The same as a JSON array.
  Json json(std::size_t most) const;
  /// Largest amount by which a count is too low.
  std::uint64_t count_error() const { return counts_.count_error(); }

 private:
  hinge::tool::FrequentKeys counts_;
  Label label_;
  std::unordered_map<std::uint32_t, std::string> labels_;  // of pairs from JSON
};

}  // namespace biocd
