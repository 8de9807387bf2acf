// SPDX-License-Identifier: BSD-3-Clause
// WorkBudget: what a query of engine/simd has done so far, and when that is too much.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hinge/detail/simd/lanes.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

struct WorkBudget {
  QueryCounts counts;           ///< rows of boxes and candidates: sixteen at a time
  QueryCounts searched;         ///< one by one
  std::uint64_t hits = 0;       ///< pairs decided in double that were wanted
  std::uint64_t misses = 0;     ///< and others
  std::uint64_t blocks_in = 0;  ///< blocks of the models asked

  /// More than a search through boxes in double would take? What finds hits is never too much.
  bool is_too_much() const noexcept {
    return counts.boxes_tested + counts.pairs_tested + candidates_per_pair * misses >
           candidates_per_block * blocks_in + candidates_per_pair * hits;
  }

  void report(QueryCounts* total) const noexcept {
    if (total == nullptr) return;
    total->boxes_tested += counts.boxes_tested * simd::width + searched.boxes_tested;
    total->nodes_split += searched.nodes_split;
    total->pairs_tested += counts.pairs_tested * simd::width + searched.pairs_tested;
    total->undecided += counts.undecided;
  }

 private:
  /// What deciding a pair in double costs, in candidates.
  static constexpr std::uint64_t candidates_per_pair = 4;
  /// Candidates, and rows of boxes, per block. Ordinary chains take a tenth of it at most, and FallbackBvh about as
  /// long as for twice as many: so a query takes at most about half as long again as the better of both.
  /// (explanation/numerics.md)
  static constexpr std::uint64_t candidates_per_block = 2048;
};

}  // namespace hinge::detail
