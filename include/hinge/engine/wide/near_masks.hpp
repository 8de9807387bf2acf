// SPDX-License-Identifier: BSD-3-Clause
// NearMasks: which lanes of a block may be tested with which of another, where the filter forbids some of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/engine/wide/block_layout.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/simd/lanes.hpp"

namespace hinge {

/// One array of masks, looked up by position: first one mask per block (its real lanes), then sixteen rows for every
/// near pair of blocks (b, a), a <= b: bit l of row k tells whether lane k of b is tested with lane l of a. Near pairs
/// are those with a pair the filter lists as excluded, and every block with itself. What a filter that lists no
/// exclusions forbids is found out pair by pair.
class NearMasks {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  /// inside_groups: are pairs within one rigid group tested?
  template <Primitive P, PairFilter F>
  NearMasks(const BlockLayout& layout, const SelectedModel<P>& model, const F& filter, bool inside_groups);

  simd::Bits mask(std::uint32_t position) const noexcept { return masks_[position]; }
  const std::uint16_t* masks() const noexcept { return masks_.data(); }

  /// Position of the first row of the pair, or none; a <= b.
  std::uint32_t find(std::uint32_t b, std::uint32_t a) const noexcept {
    for (std::uint32_t k = start_[b]; k < start_[b + 1]; ++k)
      if (partner_[k] == a) return row_[k];
    return none;
  }
  /// Rows of b with itself; only when self_lanes(b) is not empty.
  std::uint32_t self_rows(std::uint32_t b) const noexcept { return row_[start_[b + 1] - 1]; }
  /// Those of its rows that admit anything.
  simd::Bits self_lanes(std::uint32_t b) const noexcept { return self_lanes_[b]; }

  std::size_t bytes() const noexcept {
    return masks_.size() * sizeof(masks_[0]) + (start_.size() + partner_.size() + row_.size()) * 4 +
           self_lanes_.size() * sizeof(self_lanes_[0]);
  }

 private:
  std::vector<std::uint16_t> masks_;
  std::vector<std::uint16_t> self_lanes_;
  std::vector<std::uint32_t> start_;    // per block, in partner_ and row_
  std::vector<std::uint32_t> partner_;  // sorted, the block itself last
  std::vector<std::uint32_t> row_;
};

template <Primitive P, PairFilter F>
NearMasks::NearMasks(const BlockLayout& layout, const SelectedModel<P>& model, const F& filter, bool inside_groups) {
  const std::size_t blocks = layout.block_count();
  for (const Block& block : layout.blocks) masks_.push_back(static_cast<std::uint16_t>(block.real));
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
      // Two blocks of one rigid group never meet, unless groups deform.
      if (!inside_groups && mine.rigid && layout.blocks[a].rigid &&
          layout.groups_of(mine).front() == layout.groups_of(layout.blocks[a]).front())
        continue;
      partner_.push_back(a);
      row_.push_back(static_cast<std::uint32_t>(masks_.size()));
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
        masks_.push_back(static_cast<std::uint16_t>(row));
        if (a == b && row != 0) self_lanes |= simd::Bits{1} << k;
      }
    }
    self_lanes_.push_back(static_cast<std::uint16_t>(self_lanes));
    start_.push_back(static_cast<std::uint32_t>(partner_.size()));
  }
}

}  // namespace hinge
