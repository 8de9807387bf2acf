// SPDX-License-Identifier: BSD-3-Clause
// ResumePoint: the pairs that a query of engine/simd has finished before it switches to FallbackBvh.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/engine/simd/block_layout.hpp"

namespace hinge::detail {

/// A query takes entries in order, for each entry its partners in order, and for each partner some blocks of the entry.
class ResumePoint {
 public:
  /// All entries before u are finished.
  void reach(std::size_t u) noexcept {
    entry_ = u;
    partner_ = 0;
    blocks_.clear();
  }
  /// In the entry reached, all partners before w are finished, and `blocks` of the entry against partner w.
  void stop(std::size_t w, std::span<const std::uint32_t> blocks) {
    partner_ = w;
    blocks_.assign(blocks.begin(), blocks.end());
    std::sort(blocks_.begin(), blocks_.end());
  }

  /// True if a pair inside one model is finished.
  bool passed(const BlockLayout& layout, PrimitiveId i, PrimitiveId j) const noexcept {
    return layout.entry_of(i) < layout.entry_of(j) ? passed(layout, j, layout, i) : passed(layout, i, layout, j);
  }
  /// True if the pair is finished, with i in an entry taken in order and j in a partner.
  bool passed(const BlockLayout& mine, PrimitiveId i, const BlockLayout& theirs, PrimitiveId j) const noexcept {
    const std::size_t u = mine.entry_of(i), w = theirs.entry_of(j);
    if (u != entry_) return u < entry_;
    if (w != partner_) return w < partner_;
    return std::binary_search(blocks_.begin(), blocks_.end(), mine.block_of[index(i)]);
  }

 private:
  std::size_t entry_ = 0, partner_ = 0;
  std::vector<std::uint32_t> blocks_;  // sorted
};

}  // namespace hinge::detail
