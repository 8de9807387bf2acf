// SPDX-License-Identifier: BSD-3-Clause
// MovedBlocks: the blocks that a move changes: whole blocks by part, and blocks cut by a joint.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/engine/simd/block_layout.hpp"
#include "hinge/detail/moves/moving_parts.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// The lanes of a block that belong to one part.
struct PartLanes {
  std::uint32_t part;
  simd::Bits lanes;
};

/// Blocks are sorted by their first place in MovingParts; a rank is a position in this order.
class MovedBlocks {
 public:
  template <Primitive P>
  MovedBlocks(const BlockLayout& layout, const SelectedModel<P>& model, const MovingParts& parts)
      : last_(layout.block_count()),
        seen_(layout.block_count(), 0),
        reaching_(parts.size() + 1),
        from_(parts.size() + 1) {
    std::vector<std::uint32_t> first(layout.block_count());
    for (std::uint32_t b = 0; b < layout.block_count(); ++b) {
      for (std::size_t lane = 0; lane < simd::width; ++lane)
        place_.push_back(parts.place(model.group_of(id<PrimitiveId>(layout.primitive[b * simd::width + lane]))));
      const auto [least, most] = std::minmax_element(place_.end() - simd::width, place_.end());
      first[b] = *least;
      last_[b] = *most;
      order_.push_back(b);
    }
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(first[a], a) < std::pair(first[b], b); });
    std::uint32_t reaching = 0, from = 0;
    for (std::uint32_t p = 0; p <= parts.size(); ++p) {
      while (reaching < order_.size() && last_[order_[reaching]] < p) ++reaching;
      while (from < order_.size() && first[order_[from]] < p) ++from;
      reaching_[p] = reaching;
      from_[p] = from;
    }
  }

  /// All blocks sorted by their first place. A rank is a position in this list.
  std::span<const std::uint32_t> order() const noexcept { return order_; }

  /// Finds the blocks that the parts of a cut contain.
  void find(const MovingParts& parts);

  /// The blocks of ranks begin .. end - 1 lie in one part.
  struct Range {
    std::uint32_t begin, end, part;
  };

  /// Number of moving blocks.
  std::size_t count() const noexcept { return count_; }
  std::uint32_t part_count() const noexcept { return static_cast<std::uint32_t>(start_.size()) - 1; }
  /// Whole blocks in one part, and in all parts.
  std::span<const Range> of_part(std::uint32_t part) const noexcept {
    return std::span(whole_).subspan(start_[part], start_[part + 1] - start_[part]);
  }
  std::span<const Range> whole() const noexcept { return whole_; }
  /// A block that may lie in several parts.
  struct Cut {
    std::uint32_t rank, stretch;  ///< no earlier range of MovingParts contains any of its places
  };
  std::span<const Cut> cut() const noexcept { return cut_; }
  /// The place in MovingParts of the primitive in a slot.
  std::uint32_t place(std::uint32_t slot) const noexcept { return place_[slot]; }
  /// The lanes of each part in a cut block; the part with most lanes is last. Valid until the next call.
  std::span<const PartLanes> pieces(const Cut& cut, const MovingParts& parts);

 private:
  /// Adds a block that may lie only partly in stretch t.
  void add_cut(std::uint32_t rank, const MovingParts::Stretch& stretch, std::size_t t) {
    const std::uint32_t b = order_[rank];
    if (last_[b] < stretch.begin || seen_[b] == call_) return;
    seen_[b] = call_;
    cut_.push_back({rank, static_cast<std::uint32_t>(t)});
  }

  std::vector<std::uint32_t> place_;  // per slot
  std::vector<std::uint32_t> last_;   // per block: its last place
  std::vector<std::uint64_t> seen_;   // per block: the last call of find() that reached it
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> reaching_;  // per place: blocks of lower rank end before this place
  std::vector<std::uint32_t> from_;      // per place: the first rank that starts at or after it
  std::uint64_t call_ = 0;
  std::size_t count_ = 0;
  std::vector<Range> found_, whole_;
  std::vector<Cut> cut_;
  std::vector<PartLanes> pieces_;           // scratch
  std::vector<std::uint32_t> start_{0, 0};  // per part: start in whole_
};

inline std::span<const PartLanes> MovedBlocks::pieces(const Cut& cut, const MovingParts& parts) {
  const std::span<const MovingParts::Stretch> stretches = parts.stretches();
  const std::uint32_t b = order_[cut.rank];
  simd::Bits rest = simd::all_bits;
  pieces_.clear();
  const auto add = [&](std::uint32_t part, simd::Bits lanes) {
    if (lanes == 0) return;
    const auto piece = std::find_if(pieces_.begin(), pieces_.end(), [&](const PartLanes& p) { return p.part == part; });
    if (piece == pieces_.end())
      pieces_.push_back({part, lanes});
    else
      piece->lanes |= lanes;
  };
  for (std::size_t t = cut.stretch; t < stretches.size() && stretches[t].begin <= last_[b]; ++t) {
    const simd::Bits lanes = stretches[t].lanes(place_.data() + b * simd::width);
    rest &= ~lanes;
    add(stretches[t].part, lanes);
  }
  add(0, rest);
  const auto most = std::max_element(pieces_.begin(), pieces_.end(), [](const PartLanes& p, const PartLanes& q) {
    return std::popcount(p.lanes) < std::popcount(q.lanes);
  });
  std::swap(*most, pieces_.back());
  return pieces_;
}

inline void MovedBlocks::find(const MovingParts& parts) {
  ++call_;
  found_.clear();
  cut_.clear();
  start_.assign(parts.parts().size() + 1, 0);
  const std::span<const MovingParts::Stretch> stretches = parts.stretches();
  for (std::size_t t = 0; t < stretches.size(); ++t) {
    const MovingParts::Stretch& s = stretches[t];
    // Three sets: blocks that start before the range, blocks that lie in it, and blocks that may extend beyond it.
    const std::uint32_t begin = from_[s.begin], end = from_[s.end];
    const std::uint32_t beyond = std::clamp(reaching_[s.end], begin, end);
    for (std::uint32_t rank = reaching_[s.begin]; rank < begin; ++rank) add_cut(rank, s, t);
    if (begin < beyond) {
      found_.push_back({begin, beyond, s.part});
      ++start_[s.part + 1];
    }
    for (std::uint32_t rank = beyond; rank < end; ++rank) add_cut(rank, s, t);
  }
  count_ = cut_.size();
  for (std::size_t part = 1; part < start_.size(); ++part) start_[part] += start_[part - 1];
  whole_.resize(found_.size());
  for (const Range& f : found_) {
    whole_[start_[f.part]++] = f;
    count_ += f.end - f.begin;
  }
  for (std::size_t part = start_.size() - 1; part > 0; --part) start_[part] = start_[part - 1];
  start_[0] = 0;
}

}  // namespace hinge::detail
