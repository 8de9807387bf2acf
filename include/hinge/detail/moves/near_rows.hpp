// SPDX-License-Identifier: BSD-3-Clause
// NearRows: the rows of ExclusionMasks from both sides, so that a pair of near blocks can be tested from either side.
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

/// For each of the sixteen lanes of one block: mask of the lanes of the other block that it is tested with.
using LaneRows = std::array<simd::Bits, simd::width>;

class NearRows {
 public:
  struct Near {
    std::uint32_t partner;    ///< rank of the partner
    std::uint32_t mine, its;  ///< indices for rows(): from this block's side, from the partner's side
  };

  /// rank: per block.
  NearRows(const ExclusionMasks& masks, std::span<const std::uint32_t> rank) : self_(rank.size()) {
    std::vector<std::vector<Near>> lists(rank.size());
    for (std::uint32_t b = 0; b < rank.size(); ++b) {
      for (const std::uint32_t a : masks.partners(b)) {
        if (a == b) continue;
        const auto mine = static_cast<std::uint32_t>(rows_.size()), its = mine + 1;
        add(masks.find(b, a).rows);
        lists[b].push_back({rank[a], mine, its});
        lists[a].push_back({rank[b], its, mine});
      }
      if (masks.self(b).lanes == 0) continue;
      add(masks.self(b).rows);
      for (std::size_t k = 0; k < simd::width; ++k) self_[b][k] = rows_.end()[-2][k] | rows_.end()[-1][k];
      rows_.resize(rows_.size() - 2);
    }
    for (auto& list : lists) {
      start_.push_back(near_.size());
      std::sort(list.begin(), list.end(), [](const Near& x, const Near& y) { return x.partner < y.partner; });
      near_.insert(near_.end(), list.begin(), list.end());
      near_.push_back({std::numeric_limits<std::uint32_t>::max(), 0, 0});
    }
  }

  /// The near blocks of block b, sorted by rank. The last entry is a sentinel with the largest rank.
  const Near* of(std::uint32_t b) const noexcept { return near_.data() + start_[b]; }
  /// Rows k: for each lane of one block, the lanes of the other.
  const LaneRows& rows(std::uint32_t k) const noexcept { return rows_[k]; }
  /// Rows of a block with itself; each pair appears from both sides.
  const LaneRows& self(std::uint32_t b) const noexcept { return self_[b]; }

 private:
  /// Stores sixteen rows and their transpose.
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
