// SPDX-License-Identifier: BSD-3-Clause
// ExclusionMasks: bit masks of the lane pairs that may be tested, for pairs of blocks with exclusions.
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

/// A near pair of blocks (b, a), a <= b, has sixteen rows: bit l of row k is set if lane k of b may be tested with lane
/// l of a. Near pairs are the pairs of blocks that contain an excluded pair of primitives, and every block with itself.
/// Masks only save work: the filter is asked again for every pair that is close.
class ExclusionMasks {
 public:
  /// inside_groups: true if pairs within one rigid group are tested.
  template <Primitive P, PairFilter F>
  ExclusionMasks(const BlockLayout& layout, const SelectedModel<P>& model, const F& filter, bool inside_groups);

  /// Returns the rows of the pair a < b, or nullptr if it is not near.
  const simd::Bits* find(std::uint32_t b, std::uint32_t a) const noexcept { return Partners(*this, b).find(a); }
  /// Returns the rows of b with itself. Requires self_lanes(b) != 0.
  const simd::Bits* self_rows(std::uint32_t b) const noexcept { return rows_.data() + row_[start_[b + 1] - 1]; }
  /// The near blocks of b in increasing order; b itself is the last.
  std::span<const std::uint32_t> partners(std::uint32_t b) const noexcept {
    return std::span(partner_).subspan(start_[b], start_[b + 1] - start_[b]);
  }
  /// Lanes of b whose row with b itself is not empty.
  simd::Bits self_lanes(std::uint32_t b) const noexcept { return self_lanes_[b]; }

  /// Looks up near blocks of one block. Call find() with increasing arguments.
  class Partners {
   public:
    Partners(const ExclusionMasks& near, std::uint32_t b) noexcept : near_(near), next_(near.start_[b]) {}
    /// Returns the rows with block a < b, or nullptr if the pair is not near.
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
  std::vector<std::uint32_t> start_;    // per block: start in partner_ and row_
  std::vector<std::uint32_t> partner_;  // sorted per block; every list ends with the block itself
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
      // Two blocks of one rigid group are never tested unless groups deform. The block itself still ends its own list.
      const bool never = !inside_groups && mine.rigid && layout.blocks[a].rigid &&
                         layout.groups_of(mine).front() == layout.groups_of(layout.blocks[a]).front();
      if (never && a != b) continue;
      partner_.push_back(a);
      row_.push_back(static_cast<std::uint32_t>(rows_.size()));
      if (never) continue;
      for (std::size_t k = 0; k < simd::width; ++k) {
        simd::Bits row = 0;
        const std::size_t end = a == b ? k : simd::width;  // each pair within a block once
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
