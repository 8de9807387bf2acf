// SPDX-License-Identifier: BSD-3-Clause
// ExclusionMasks: which lanes of a block may be tested with which of another, where the filter forbids some of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/engine/simd/block_layout.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// A near pair of blocks (b, a), a <= b, has sixteen rows: bit l of row k tells whether lane k of b is tested with lane
/// l of a. Near pairs are those with a pair the filter lists as excluded, and every block with itself. Masks only leave
/// pairs out early: what comes too close is asked of the filter in any case.
class ExclusionMasks {
 public:
  /// inside_groups: are pairs within one rigid group tested?
  template <Primitive P, PairFilter F>
  ExclusionMasks(const BlockLayout& layout, const SelectedModel<P>& model, const F& filter, bool inside_groups);

  /// The rows of the pair, or nullptr; a < b.
  const simd::Bits* find(std::uint32_t b, std::uint32_t a) const noexcept { return Partners(*this, b).find(a); }
  /// Rows of b with itself; only when self_lanes(b) is not empty.
  const simd::Bits* self_rows(std::uint32_t b) const noexcept { return rows_.data() + row_[start_[b + 1] - 1]; }
  /// The near blocks of b up to b itself, which ends them.
  std::span<const std::uint32_t> partners(std::uint32_t b) const noexcept {
    return std::span(partner_).subspan(start_[b], start_[b + 1] - start_[b]);
  }
  /// Those of its rows that admit anything.
  simd::Bits self_lanes(std::uint32_t b) const noexcept { return self_lanes_[b]; }

  /// The near blocks of one block, to be asked for in increasing order.
  class Partners {
   public:
    Partners(const ExclusionMasks& near, std::uint32_t b) noexcept : near_(near), next_(near.start_[b]) {}
    /// The rows with block a, or nullptr; a < b.
    const simd::Bits* find(std::uint32_t a) noexcept {
      while (near_.partner_[next_] < a) ++next_;
      return near_.partner_[next_] == a ? near_.rows_.data() + near_.row_[next_] : nullptr;
    }

   private:
    const ExclusionMasks& near_;
    std::size_t next_;
  };

 private:
  simd::AlignedVector<simd::Bits> rows_;
  std::vector<std::uint16_t> self_lanes_;
  std::vector<std::uint32_t> start_;    // per block, in partner_ and row_
  std::vector<std::uint32_t> partner_;  // sorted; the block itself ends every list
  std::vector<std::uint32_t> row_;
};

template <Primitive P, PairFilter F>
ExclusionMasks::ExclusionMasks(const BlockLayout& layout, const SelectedModel<P>& model, const F& filter,
                               bool inside_groups) {
  const std::size_t blocks = layout.block_count();
  start_.assign(1, 0);
  std::vector<std::uint32_t> near;
  for (std::uint32_t b = 0; b < blocks; ++b) {
    const Block& mine = layout.blocks[b];
    const auto primitive = [&](std::uint32_t block, std::size_t lane) {
      return id<PrimitiveId>(layout.primitive[block * simd::width + lane]);
    };
    near.assign(1, b);
    if constexpr (ListsExclusions<F>)
      for (std::size_t k = 0; mine.real >> k != 0; ++k)
        for (const PrimitiveId j : std::span<const PrimitiveId>(filter.excluded(primitive(b, k))))
          if (layout.block_of[index(j)] < b) near.push_back(layout.block_of[index(j)]);
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    simd::Bits self_lanes = 0;
    for (const std::uint32_t a : near) {
      // Two blocks of one rigid group never meet, unless groups deform; but the block itself ends its list.
      const bool never = !inside_groups && mine.rigid && layout.blocks[a].rigid &&
                         layout.groups_of(mine).front() == layout.groups_of(layout.blocks[a]).front();
      if (never && a != b) continue;
      partner_.push_back(a);
      row_.push_back(static_cast<std::uint32_t>(rows_.size()));
      if (never) continue;
      for (std::size_t k = 0; k < simd::width; ++k) {
        simd::Bits row = 0;
        const std::size_t end = a == b ? k : simd::width;  // each pair of a block with itself once
        for (std::size_t l = 0; l < end && (mine.real >> k & 1U) != 0; ++l) {
          if ((layout.blocks[a].real >> l & 1U) == 0) continue;
          const PrimitiveId i = primitive(b, k), j = primitive(a, l);
          const bool same = !inside_groups && model.group_of(i) == model.group_of(j);
          bool admitted = !same;
          if constexpr (ListsExclusions<F>) admitted = admitted && filter.admits(i, j);
          if (admitted) row |= simd::Bits{1} << l;
        }
        rows_.push_back(row);
        if (a == b && row != 0) self_lanes |= simd::Bits{1} << k;
      }
    }
    self_lanes_.push_back(static_cast<std::uint16_t>(self_lanes));
    start_.push_back(static_cast<std::uint32_t>(partner_.size()));
  }
}

}  // namespace hinge::detail
