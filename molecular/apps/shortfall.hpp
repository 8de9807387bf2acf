// SPDX-License-Identifier: BSD-3-Clause
// Shortfall: the samples that a run could not draw, and why.
#pragma once

#include <cstdint>
#include <span>

#include "hinge/molecular/structure.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge_tools/frequent_keys.hpp"

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

 private:
  const hinge::molecular::Structure& structure_;
  std::uint64_t missing_ = 0, stopped_ = 0;
  hinge::tool::FrequentKeys blockers_;  // pairs of residues
};

}  // namespace biocd
