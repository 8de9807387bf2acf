// SPDX-License-Identifier: BSD-3-Clause
// SimdSide: one model in a query of engine/simd: its blocks in their present state, and searches through them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/block_layout.hpp"
#include "hinge/detail/engine/simd/exclusion_masks.hpp"
#include "hinge/detail/engine/simd/placed_blocks.hpp"
#include "hinge/detail/query/pair_threshold.hpp"
#include "hinge/detail/simd/gather_bits.hpp"
#include "hinge/model/state.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// Owns the state of one layout of one model. Extra clearances are kept per block, scaled.
template <Primitive P>
class SimdSide {
 public:
  static constexpr std::size_t no_component = ~std::size_t{0};

  template <PairFilter F>
  SimdSide(std::shared_ptr<const SimdParts<P>> parts, const SelectedModel<P>& model, const F& filter,
           bool inside_groups)
      : near_(std::make_shared<const ExclusionMasks>(parts->layout, model, filter, inside_groups)),
        table_(parts->classes.table(parts->layout.scale)),
        blocks_(std::move(parts), model),
        grown_(layout().entries.size()) {}

  const BlockLayout& layout() const noexcept { return blocks_.parts().layout; }
  const SimdParts<P>& parts() const noexcept { return blocks_.parts(); }
  const ExclusionMasks& near() const noexcept { return *near_; }
  const ThresholdTable& table() const noexcept { return table_; }
  PlacedBlocks<P>& blocks() noexcept { return blocks_; }
  const PlacedBlocks<P>& blocks() const noexcept { return blocks_; }

  /// A primitive of the layout, placed in double.
  const P& exact(PrimitiveId i, State<P>& state) noexcept {
    const std::uint32_t b = layout().block_of[index(i)];
    const std::uint32_t* const first = layout().primitive.data() + b * simd::width;
    return blocks_.exact(b, state)[std::find(first, first + simd::width, index(i)) - first];
  }

  /// The block of a slot, placed in double: all of it, or only the given lanes.
  [[gnu::always_inline]] const P* exact_block(std::uint32_t slot, simd::Bits lanes, bool only_lanes,
                                              State<P>& state) noexcept {
    const auto b = static_cast<std::uint32_t>(slot / simd::width);
    return only_lanes ? blocks_.exact(b, lanes, state) : blocks_.exact(b, state);
  }

  /// Starts a query with its options. After this, refresh() updates entries one by one.
  void begin(State<P>& state, bool moved_only, std::span<const double> clearance) {
    blocks_.begin(state);
    has_extra_ = !clearance.empty();
    largest_extra_ = 0.0F;
    if (has_extra_) {
      extra_.resize(layout().block_count() * Batch<P>::floats);
      float* at = extra_.data();
      for (const Block& block : layout().blocks) {
        double extra = 0.0;
        for (const GroupId g : layout().groups_of(block)) extra = std::max(extra, clearance_of(clearance, g));
        const float scaled = float_above(extra * layout().scale);
        std::fill_n(at, simd::width, scaled);
        at += Batch<P>::floats;
        largest_extra_ = std::max(largest_extra_, scaled);
      }
      for (std::size_t u = 0; u < blocks_.first_entry(); ++u) grow(u);
    }
    component_.clear();
    if (moved_only && !state.groups_may_deform())
      for (const SweepEntry& entry : layout().entries) {
        const auto groups = layout().groups_of(layout().blocks[entry.first_block]);
        std::size_t component = state.component(groups.front());
        for (const GroupId g : groups)
          if (state.component(g) != component) component = no_component;
        component_.push_back(component);
      }
  }

  /// Updates an entry. Call it for entries in increasing order, from blocks().first_entry() on.
  [[gnu::always_inline]] void refresh(std::size_t u, State<P>& state) noexcept {
    blocks_.refresh(u, state);
    if (has_extra()) [[unlikely]]
      grow(u);
  }
  /// Boxes of entries, inflated by their reach and their extra clearance.
  EntryBoxes& entries() noexcept { return has_extra() ? grown_ : blocks_.entries(); }

  /// Float coordinates of all blocks, and the threshold class of the primitive that starts at each position.
  const float* packed() const noexcept { return blocks_.packed(0); }
  const std::uint8_t* position_class() const noexcept { return parts().position_class.data(); }
  /// Thresholds, in model units, between the primitive at a position and each class. Null if a class holds several
  /// types, or with extra clearances.
  const double* exact_row(std::uint32_t position) const noexcept {
    return has_extra_ ? nullptr : parts().classes.exact_row(position_class()[position]);
  }

  /// Extra clearances, scaled: at the position of a primitive's floats, and of a block.
  bool has_extra() const noexcept { return has_extra_; }
  float extra_at(std::uint32_t position) const noexcept { return has_extra_ ? extra_[position] : 0.0F; }
  float extra(std::uint32_t block) const noexcept {
    return extra_at(block * static_cast<std::uint32_t>(Batch<P>::floats));
  }
  float largest_extra() const noexcept { return largest_extra_; }

  /// In a moved-only query: true if the two entries (or all groups inside one, if u == w) kept their relative
  /// placement.
  bool kept_apart(std::size_t u, std::size_t w) const noexcept {
    return !component_.empty() && component_[u] == component_[w] && component_[u] != no_component;
  }

  /// True if the entry may have moved in the last update.
  bool moved(std::size_t u, State<P>& state) const noexcept {
    for (const GroupId g : layout().groups_of(layout().blocks[layout().entries[u].first_block]))
      if (state.moved(g)) return true;
    return false;
  }

  /// Lists in `blocks` the blocks of entry u's tree whose boxes overlap `box`.
  void descend(std::size_t u, const FloatBox& box, State<P>& state, QueryCounts& counts,
               std::vector<std::uint32_t>& blocks) {
    blocks.clear();
    const BoxLanes probe(box);
    const std::vector<BlockTree::Level>& levels = parts().rigid.tree[u].levels;
    struct Node {
      std::uint32_t row, level;
    };
    // A level has up to sixteen times the boxes of the level above it. Eight levels exceed a 32-bit index. Each level
    // leaves at most fifteen rows on the stack.
    std::array<Node, 8 * simd::width> stack;
    std::size_t waiting = 0;
    stack[waiting++] = {0, static_cast<std::uint32_t>(levels.size() - 1)};
    std::array<std::uint32_t, simd::width> found;
    while (waiting > 0) {
      const Node node = stack[--waiting];
      const BoxRow& boxes = blocks_.tree_row(u, levels[node.level].first_row + node.row, state);
      ++counts.boxes_tested;
      const auto first = static_cast<std::uint32_t>(node.row * simd::width);
      simd::Bits bits = overlapping(boxes, probe);
      // Mask unused lanes explicitly: an infinite probe overlaps their sentinels.
      if (levels[node.level].boxes - first < simd::width)
        bits &= (simd::Bits{1} << (levels[node.level].boxes - first)) - 1;
      const std::size_t n = simd::append_lanes(bits, first, found.data());
      for (std::size_t k = 0; k < n; ++k) {
        if (node.level == 0)
          blocks.push_back(layout().entries[u].first_block + found[k]);
        else
          stack[waiting++] = {found[k], node.level - 1};
      }
    }
  }

 private:
  [[gnu::noinline]] void grow(std::size_t u) noexcept {
    grown_.set(u, blocks_.entries().get(u).grown(extra(layout().entries[u].first_block)));
    grown_.close(u);
  }

  std::shared_ptr<const ExclusionMasks> near_;
  ThresholdTable table_;
  PlacedBlocks<P> blocks_;
  bool has_extra_ = false;
  std::vector<float> extra_;  // per float position of a block; scaled
  EntryBoxes grown_;          // boxes of entries with extra clearances
  float largest_extra_ = 0.0F;
  std::vector<std::size_t> component_;  // per entry; empty: no pair of entries is skipped
};

}  // namespace hinge::detail
