// SPDX-License-Identifier: BSD-3-Clause
// WorkBudget: the work that a query of engine/simd has done, and the limit after which it switches to FallbackBvh.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hinge/detail/simd/lanes.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

struct WorkBudget {
  QueryCounts counts;           ///< rows of boxes, and candidates: each counts sixteen pairs
  QueryCounts searched;         ///< work of FallbackBvh, counted pair by pair
  std::uint64_t hits = 0;       ///< pairs decided in double that the collector wanted
  std::uint64_t misses = 0;     ///< pairs decided in double that it did not want
  std::uint64_t blocks_in = 0;  ///< blocks of all models in the query

  /// Returns true if a search with boxes in double would cost less. Work that finds hits never exceeds the budget.
  bool is_too_much() const noexcept {
    return counts.boxes_tested + counts.pairs_tested + candidates_per_pair * misses >
           candidates_per_block * blocks_in + candidates_per_pair * hits;
  }

  void report(QueryCounts* total) const noexcept {
    if (total == nullptr) return;
    total->boxes_tested += counts.boxes_tested * simd::width + searched.boxes_tested;
    total->nodes_split += searched.nodes_split;
    total->pairs_tested += counts.pairs_tested * simd::width + searched.pairs_tested;
  }

 private:
  /// Cost of deciding a pair in double, in candidates.
  static constexpr std::uint64_t candidates_per_pair = 4;
  /// Candidates and rows of boxes allowed per block. Ordinary chains need a tenth of it at most. FallbackBvh costs
  /// about as much as twice this number, so a query costs at most about 1.5 times the better of the two methods
  /// (docs/explanation/numerics.md).
  static constexpr std::uint64_t candidates_per_block = 2048;
};

}  // namespace hinge::detail
