// SPDX-License-Identifier: BSD-3-Clause
// NearRows: the rows of ExclusionMasks from both sides, so that a pair of near blocks is tested from the cheaper one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "hinge/detail/engine/simd/exclusion_masks.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// Which lanes of the one are tested with each of the sixteen lanes of the other.
using LaneRows = std::array<simd::Bits, simd::width>;

class NearRows {
 public:
  struct Near {
    std::uint32_t partner;    ///< its rank
    std::uint32_t mine, its;  ///< rows()
  };

  /// rank: of every block.
  NearRows(const ExclusionMasks& masks, std::span<const std::uint32_t> rank) : self_(rank.size()) {
    std::vector<std::vector<Near>> lists(rank.size());
    for (std::uint32_t b = 0; b < rank.size(); ++b) {
      for (const std::uint32_t a : masks.partners(b)) {
        if (a == b) continue;
        const auto mine = static_cast<std::uint32_t>(rows_.size()), its = mine + 1;
        add(masks.find(b, a));
        lists[b].push_back({rank[a], mine, its});
        lists[a].push_back({rank[b], its, mine});
      }
      if (masks.self_lanes(b) == 0) continue;
      add(masks.self_rows(b));
      for (std::size_t k = 0; k < simd::width; ++k) self_[b][k] = rows_.end()[-2][k] | rows_.end()[-1][k];
      rows_.resize(rows_.size() - 2);
    }
    for (auto& list : lists) {
      start_.push_back(near_.size());
      std::ranges::sort(list, {}, &Near::partner);
      near_.insert(near_.end(), list.begin(), list.end());
      near_.push_back({std::numeric_limits<std::uint32_t>::max(), 0, 0});
    }
  }

  /// The near blocks of a block by their ranks, ended by one beyond all.
  const Near* of(std::uint32_t b) const noexcept { return near_.data() + start_[b]; }
  /// For each lane of the one the lanes of the other.
  const LaneRows& rows(std::uint32_t k) const noexcept { return rows_[k]; }
  /// Of a block with itself, each pair from both sides.
  const LaneRows& self(std::uint32_t b) const noexcept { return self_[b]; }

 private:
  /// Sixteen rows, and what they say of the other block's lanes.
  void add(const simd::Bits* rows) {
    LaneRows forth{}, back{};
    std::copy_n(rows, simd::width, forth.begin());
    for (std::size_t k = 0; k < simd::width; ++k)
      for (std::size_t l = 0; l < simd::width; ++l) back[l] |= (forth[k] >> l & 1U) << k;
    rows_.push_back(forth);
    rows_.push_back(back);
  }

  std::vector<LaneRows> rows_, self_;
  std::vector<Near> near_;
  std::vector<std::size_t> start_;  // per block
};

}  // namespace hinge::detail
