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

/// The lanes of a near pair of blocks (b, a) that may be tested. Bit l of rows[k] is set if lane k of b may be tested
/// with lane l of a. Bit k of `lanes` is set if rows[k] is not empty.
struct NearRows16 {
  const simd::Bits* rows = nullptr;  ///< nullptr: the pair is not near, all lanes may be tested
  simd::Bits lanes = simd::all_bits;
};

/// Near pairs (b, a), a <= b, are the pairs of blocks that contain a pair of primitives known to be excluded, and every
/// block with itself. A filter's lists say which pairs are excluded. If it has none, every pair of a small model is
/// asked. Masks only save work: the filter is asked again for every pair that is close.
class ExclusionMasks {
 public:
  /// inside_groups: true if pairs within one rigid group are tested.
  template <Primitive P, PairFilter F>
  ExclusionMasks(const BlockLayout& layout, const SelectedModel<P>& model, const F& filter, bool inside_groups);

  /// Returns the rows of the pair a < b.
  NearRows16 find(std::uint32_t b, std::uint32_t a) const noexcept { return Partners(*this, b).find(a); }
  /// Returns the rows of b with itself.
  NearRows16 self(std::uint32_t b) const noexcept { return get(start_[b + 1] - 1); }
  /// The near blocks of b in increasing order; b itself is the last.
  std::span<const std::uint32_t> partners(std::uint32_t b) const noexcept {
    return std::span(partner_).subspan(start_[b], start_[b + 1] - start_[b]);
  }

  /// Looks up near blocks of one block. Call find() with increasing arguments.
  class Partners {
   public:
    Partners(const ExclusionMasks& near, std::uint32_t b) noexcept : near_(near), next_(near.start_[b]) {}
    /// Returns the rows with block a < b.
    NearRows16 find(std::uint32_t a) noexcept {
      while (near_.partner_[next_] < a) ++next_;
      return near_.partner_[next_] == a ? near_.get(next_) : NearRows16{};
    }

   private:
    const ExclusionMasks& near_;
    std::size_t next_;
  };

 private:
  /// Largest number of blocks of which all pairs of primitives are asked: half a million.
  static constexpr std::size_t most_asked = 64;

  NearRows16 get(std::size_t k) const noexcept { return {rows_.data() + row_[k], lanes_[k]}; }

  simd::AlignedVector<simd::Bits> rows_;
  std::vector<std::uint32_t> start_;    // per block: start in the next three lists
  std::vector<std::uint32_t> partner_;  // sorted per block; every list ends with the block itself
  std::vector<std::uint32_t> row_;
  std::vector<simd::Bits> lanes_;
};

template <Primitive P, PairFilter F>
ExclusionMasks::ExclusionMasks(const BlockLayout& layout, const SelectedModel<P>& model, const F& filter,
                               bool inside_groups) {
  const std::size_t blocks = layout.block_count();
  const bool ask_all = !ListsExclusions<F> && blocks <= most_asked;
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
    for (std::uint32_t a = 0; ask_all && a < b; ++a) near.push_back(a);
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::uint32_t a : near) {
      // Two blocks of one rigid group are never tested unless groups deform. The block itself still ends its own list.
      const bool never = !inside_groups && mine.rigid && layout.blocks[a].rigid &&
                         layout.groups_of(mine).front() == layout.groups_of(layout.blocks[a]).front();
      if (never && a != b) continue;
      const std::size_t row = rows_.size();
      simd::Bits lanes = 0;
      bool all = a != b;  // every pair may be tested
      for (std::size_t k = 0; k < simd::width && !never; ++k) {
        simd::Bits admitted = 0, real = 0;
        const std::size_t end = a == b ? k : simd::width;  // each pair within a block once
        for (std::size_t l = 0; l < end && (mine.real >> k & 1U) != 0; ++l) {
          if ((layout.blocks[a].real >> l & 1U) == 0) continue;
          real |= simd::Bits{1} << l;
          const PrimitiveId i = primitive(b, k), j = primitive(a, l);
          if (!inside_groups && model.group_of(i) == model.group_of(j)) continue;
          if ((ListsExclusions<F> || ask_all) && !filter.admits(i, j)) continue;
          admitted |= simd::Bits{1} << l;
        }
        rows_.push_back(admitted);
        lanes |= simd::Bits{admitted != 0} << k;
        all = all && admitted == real;
      }
      if (all) {
        rows_.resize(row);
        continue;
      }
      partner_.push_back(a);
      row_.push_back(static_cast<std::uint32_t>(row));
      lanes_.push_back(lanes);
    }
    start_.push_back(static_cast<std::uint32_t>(partner_.size()));
  }
}

}  // namespace hinge::detail
