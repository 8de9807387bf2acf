// SPDX-License-Identifier: BSD-3-Clause
// Shortfall: the samples that a run could not draw, and why.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hinge/molecular/structure.hpp"
#include "hinge/policy/collector.hpp"
#include "pair_counts.hpp"
#include "report.hpp"

namespace biocd {

/// Number of pairs of residues in the JSON summary of a run.
inline constexpr std::size_t most_in_the_way = 10;

/// Counts missing samples, of a run or of its units.
class Shortfall {
 public:
  /// Adds a missing sample. blockers: see FreeSample. stopped: the time was over. The structure must outlive this
  /// object.
  void add(const hinge::molecular::Structure& structure, std::span<const hinge::Hit> blockers, bool stopped);
  /// Adds the missing samples of a unit by what add_to() wrote, all pairs included.
  void add(std::uint64_t missing, const Json& summary);

  /// Prints to standard error how many samples are missing and why; nothing if none is. asked: number of samples.
  /// most_starts: for each of them.
  void print(bool collision_free, std::uint64_t asked, std::uint64_t most_starts) const;
  /// Adds to a JSON summary how many samples --time cut off, and the pairs of residues that were most often in the way
  /// of the others; nothing if none is missing.
  void add_to(Json& summary, std::size_t most_pairs) const;

 private:
  std::uint64_t missing_ = 0, stopped_ = 0;
  PairCounts blockers_;  // residues
};

}  // namespace biocd
