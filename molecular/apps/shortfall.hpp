// SPDX-License-Identifier: BSD-3-Clause
// Shortfall: the samples that a run could not draw, and why.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hinge/molecular/structure.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge_tools/frequent_keys.hpp"
#include "report.hpp"

namespace biocd {

/// Counts missing samples. The structure must outlive this object.
class Shortfall {
 public:
  explicit Shortfall(const hinge::molecular::Structure& structure) : structure_(structure) {}

  /// Adds a missing sample. blockers: see FreeSample. stopped: the time was over.
  void add(std::span<const hinge::Hit> blockers, bool stopped);
  /// Prints to standard error how many samples are missing and why; nothing if none is. asked: number of samples.
  /// most_starts: for each of them.
  void print(bool collision_free, std::uint64_t asked, std::uint64_t most_starts) const;
  /// Adds to a JSON summary how many samples --time cut off, and the pairs of residues in the way of the others.
  void add_to(Json& summary) const;

 private:
  struct Pair {
    std::string first, second;  ///< residues
    std::uint64_t count;        ///< of their pairs of atoms, in the last start of each sample
  };
  /// Returns the pairs that were most often in the way.
  std::vector<Pair> top(std::size_t most) const;

  const hinge::molecular::Structure& structure_;
  std::uint64_t missing_ = 0, stopped_ = 0;
  hinge::tool::FrequentKeys blockers_;  // pairs of residues
};

}  // namespace biocd
