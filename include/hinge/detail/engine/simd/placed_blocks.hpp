// SPDX-License-Identifier: BSD-3-Clause
// PlacedBlocks: float coordinates of blocks and their boxes for the present configuration, computed on first use.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/block_layout.hpp"
#include "hinge/detail/engine/simd/entry_boxes.hpp"
#include "hinge/detail/engine/simd/float_transform.hpp"
#include "hinge/detail/engine/simd/rigid_blocks.hpp"
#include "hinge/detail/engine/simd/simd_parts.hpp"
#include "hinge/detail/primitive/batch.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/model/state.hpp"

namespace hinge::detail {

/// Coordinates are (world - origin) * scale in float. They are computed from the placement on first use after an
/// update, and kept while their groups do not move.
template <Primitive P>
class PlacedBlocks {
 public:
  PlacedBlocks(std::shared_ptr<const SimdParts<P>> parts, const SelectedModel<P>& model)
      : parts_(std::move(parts)),
        packed_(parts_->layout.block_count() * Batch<P>::floats),
        block_box_(parts_->layout.block_count()),
        block_at_(parts_->layout.block_count(), 0),
        exact_at_(parts_->layout.block_count(), 0),
        entry_at_(parts_->layout.entries.size(), 0),
        entries_(parts_->layout.entries.size()),
        entry_extent_(entries_.rows() * simd::width, 0.0F),
        tree_rows_(parts_->rigid.rows.size()),
        row_at_(parts_->rigid.rows.size(), 0),
        origin_(parts_->layout.origin) {
    for (const std::uint32_t i : parts_->layout.primitive) exact_.push_back(model.primitives()[i]);
    for (std::size_t b = 0; b < parts_->layout.block_count(); ++b)
      set_radii<P>(packed_.data() + b * Batch<P>::floats, parts_->layout.members(b), model.primitives(),
                   parts_->layout.scale);
  }

  const SimdParts<P>& parts() const noexcept { return *parts_; }
  const Vec3& origin() const noexcept { return origin_; }

  /// Call this after an update, before refresh().
  void begin(State<P>& state) noexcept {
    extent_ = static_extent_;
    update_ = state.update_number();
    few_moved_ = state.few_moved();
    given_ = state.groups_may_deform();
    if (given_ && !parts_->layout.primitive.empty()) {
      const Aabb box = state.placed()[parts_->layout.primitive.front()].bounds();
      for (int k = 0; k < 3; ++k) origin_[k] = box.middle(k);
    }
  }

  /// Updates the box of an entry and the coordinates of a mixed block. Call it for entries in increasing order.
  void refresh(std::size_t u, State<P>& state) noexcept {
    if (entry_at_[u] != update_) refresh_stale(u, state);
    if (entry_extent_[u] > extent_) {
      // Round up to a power of two, so that dependent values change rarely.
      int exponent = 0;
      std::frexp(std::min(entry_extent_[u], 0x1p126F), &exponent);
      extent_ = std::ldexp(1.0F, exponent);
    }
    entries_.close(u);
    if (u + 1 == parts_->layout.static_entries) {
      static_refreshed_ = true;
      static_extent_ = extent_;
    }
  }
  /// The first entry that refresh() must update. Static entries are placed only once.
  std::size_t first_entry() const noexcept { return static_refreshed_ ? parts_->layout.static_entries : 0; }

  /// Boxes of entries, inflated by their reach.
  EntryBoxes& entries() noexcept { return entries_; }

  /// Float coordinates of a block of a refreshed entry, placed on first use.
  const float* block(std::uint32_t b, State<P>& state) noexcept {
    if (block_at_[b] != update_) touch(b, state);
    return packed(b);
  }
  /// The sixteen primitives of a block, placed in double on first use.
  [[gnu::always_inline]] const P* exact(std::uint32_t b, State<P>& state) noexcept {
    if (exact_at_[b] != update_) place_exact(b, state);
    return exact_.data() + b * simd::width;
  }
  /// The same, but only the given lanes are placed.
  [[gnu::always_inline]] const P* exact(std::uint32_t b, simd::Bits lanes, State<P>& state) noexcept {
    if (exact_at_[b] != update_) place_exact(b, lanes, state);
    return exact_.data() + b * simd::width;
  }
  const float* packed(std::uint32_t b) const noexcept { return packed_.data() + b * Batch<P>::floats; }
  /// The block's box, inflated by its reach. Only for placed blocks.
  const FloatBox& block_box(std::uint32_t b) const noexcept { return block_box_[b]; }

  /// World boxes of a row of an entry's tree, inflated by the entry's reach.
  const BoxRow& tree_row(std::size_t u, std::uint32_t row, State<P>& state) noexcept {
    if (row_at_[row] != update_) {
      const Block& block = parts_->layout.blocks[parts_->layout.entries[u].first_block];
      if (!is_current(block, row_at_[row], state)) {
        std::array<float, simd::width> extents;
        turn(block, state)
            .turn_row(parts_->rigid.rows[row], parts_->rigid.entry[u], parts_->rigid.entry_reach[u], 0, simd::width,
                      tree_rows_[row], extents.data());
      }
      row_at_[row] = update_;
    }
    return tree_rows_[row];
  }

  /// Box of a block in an entry's tree, inflated by the entry's reach. The block need not be placed.
  FloatBox tree_box(std::size_t u, std::uint32_t b, State<P>& state) noexcept {
    const std::uint32_t k = b - parts_->layout.entries[u].first_block,
                        row = k / static_cast<std::uint32_t>(simd::width);
    return tree_row(u, parts_->rigid.tree[u].levels.front().first_row + row, state).get(k % simd::width);
  }

  /// Largest coordinate magnitude since begin(), scaled, rounded up to a power of two.
  float extent() const noexcept { return extent_; }

  /// Bound of the error of float distances and boxes, scaled, for coordinates up to extent() and for thresholds and
  /// cutoffs up to `largest` (scaled). Derivation: docs/explanation/float_filter.md.
  double band(double largest) const noexcept {
    constexpr double u = 0x1p-24, v = 0x1p-53, underflow = 0x1p-60;
    const auto extent = static_cast<double>(extent_), half = static_cast<double>(parts_->rigid.largest_half);
    const double size = extent + parts_->layout.scale * (4 * parts_->rigid.largest_local + 2 * std::abs(origin_[0]) +
                                                         2 * std::abs(origin_[1]) + 2 * std::abs(origin_[2]));
    return 6 * u * (2 * extent + 10 * half) + Batch<P>::slack * u * extent + 8 * u * largest + 16 * v * size +
           underflow;
  }

 private:
  /// The float transform of a rigid block's group.
  FloatTransform turn(const Block& block, State<P>& state) const noexcept {
    return {state.frame(parts_->layout.groups_of(block).front()), origin_, parts_->layout.scale};
  }

  /// True if the block's groups have not moved since update `since`.
  bool is_current(const Block& block, std::uint64_t since, State<P>& state) const noexcept {
    if (since == 0) return false;
    const auto groups = parts_->layout.groups_of(block);
    // Group 0 is the world. It never moves, even if given coordinates placed its primitives elsewhere in between.
    if (!given_ && groups.size() == 1 && groups.front() == GroupId{0}) return true;
    if (!few_moved_) return false;
    for (const GroupId g : groups)
      if (state.version(g) > since) return false;
    return true;
  }

  void set_entry(std::size_t u, const FloatBox& box) noexcept {
    entry_extent_[u] = box.extent();
    entries_.set(u, box);
    entry_at_[u] = update_;
  }

  void refresh_stale(std::size_t u, State<P>& state) noexcept {
    const SweepEntry& entry = parts_->layout.entries[u];
    const Block& block = parts_->layout.blocks[entry.first_block];
    if (is_current(block, entry_at_[u], state)) {
      entry_at_[u] = update_;
      if (!block.rigid) block_at_[entry.first_block] = update_;
      return;
    }
    const float reach = parts_->rigid.entry_reach[u];
    if (!block.rigid) {
      place_mixed(entry.first_block, state);
      set_entry(u, block_box_[entry.first_block]);
    } else if (entry.block_count > 1) {
      set_entry(u, turn(block, state)(parts_->rigid.entry[u]).grown(reach));
    } else {
      // Update all entries of the group at once; u is the first.
      const FloatTransform turn_group = turn(block, state);
      const LocalRow* local = &parts_->rigid.rows[parts_->rigid.flat_row[u]];
      const std::size_t end = u + parts_->rigid.flat_count[u];
      for (std::size_t first = u; first < end; ++local) {
        const std::size_t row = first / simd::width, last = std::min(end, (row + 1) * simd::width);
        turn_group.turn_row(*local, parts_->rigid.entry[u], reach, first - row * simd::width, last - row * simd::width,
                            entries_.row(row), entry_extent_.data() + row * simd::width);
        first = last;
      }
      std::fill(entry_at_.begin() + static_cast<std::ptrdiff_t>(u),
                entry_at_.begin() + static_cast<std::ptrdiff_t>(end), update_);
    }
  }

  void touch(std::uint32_t b, State<P>& state) noexcept {
    const Block& block = parts_->layout.blocks[b];
    if (!is_current(block, block_at_[b], state)) place_rigid(b, state);
    block_at_[b] = update_;
  }

  void place_mixed(std::uint32_t b, State<P>& state) noexcept {
    const BlockLayout& layout = parts_->layout;
    float* at = packed_.data() + b * Batch<P>::floats;
    FloatBox box;
    if (given_) {
      for (std::size_t k = 0; k < simd::width; ++k)
        Batch<P>::set(at, k, state.placed()[layout.primitive[b * simd::width + k]], origin_, layout.scale);
      box = Batch<P>::hull(at);
    } else {
      const std::uint32_t first = parts_->mixed_slot[b];
      box = Batch<P>::place(at, parts_->mixed.data() + first, parts_->mixed_group.data() + first,
                            state.frames_through(layout.groups_of(layout.blocks[b]).back()), origin_, layout.scale);
    }
    block_box_[b] = sane(box, {at, Batch<P>::coordinates}).grown(parts_->rigid.reach[b]);
    block_at_[b] = update_;
  }

  void place_rigid(std::uint32_t b, State<P>& state) noexcept {
    const BlockLayout& layout = parts_->layout;
    const Block& block = layout.blocks[b];
    float* at = packed_.data() + b * Batch<P>::floats;
    FloatBox box;
    if constexpr (TransformsBatch<P>) {
      const FloatTransform turn_group = turn(block, state);
      box = Batch<P>::turn(parts_->rigid.offsets.data() + b * Batch<P>::floats, turn_group.rotation(),
                           turn_group(parts_->rigid.block[b].middle), at);
    } else {
      const Pose pose = state.frame(layout.groups_of(block).front()).pose();
      for (std::size_t k = 0; k < simd::width; ++k)
        Batch<P>::set(at, k, state.model().primitives()[layout.primitive[b * simd::width + k]].placed(pose), origin_,
                      layout.scale);
      box = Batch<P>::hull(at);
    }
    block_box_[b] = sane(box, {at, Batch<P>::coordinates}).grown(parts_->rigid.reach[b]);
  }

  [[gnu::noinline]] void place_exact(std::uint32_t b, State<P>& state) noexcept {
    const Block& block = parts_->layout.blocks[b];
    if (!is_current(block, exact_at_[b], state)) {
      if (block.rigid && !given_)
        state.place(parts_->layout.groups_of(block).front(), parts_->layout.members(b),
                    exact_.data() + b * simd::width);
      else
        place_exact(b, simd::all_bits, state);
    }
    exact_at_[b] = update_;
  }
  [[gnu::noinline]] void place_exact(std::uint32_t b, simd::Bits lanes, State<P>& state) noexcept {
    const BlockLayout& layout = parts_->layout;
    for (; lanes != 0; lanes &= lanes - 1) {
      const std::size_t slot = b * simd::width + static_cast<std::size_t>(std::countr_zero(lanes));
      const auto i = id<PrimitiveId>(layout.primitive[slot]);
      exact_[slot] = given_ ? state.placed()[index(i)] : state.alone(i);
    }
  }

  std::shared_ptr<const SimdParts<P>> parts_;
  simd::AlignedVector<float> packed_;
  std::vector<FloatBox> block_box_;
  std::vector<std::uint64_t> block_at_;  // per block: the last update for which its coordinates are current
  std::vector<P> exact_;                 // per slot
  std::vector<std::uint64_t> exact_at_;  // per block: the same for its primitives in exact_
  std::vector<std::uint64_t> entry_at_;  // per entry: the same for its box
  EntryBoxes entries_;
  std::vector<float> entry_extent_;  // per lane of entries_: largest magnitude in the box
  std::vector<BoxRow> tree_rows_;
  std::vector<std::uint64_t> row_at_;
  Vec3 origin_;
  std::uint64_t update_ = 0;
  float extent_ = 0.0F;
  float static_extent_ = 0.0F;
  bool static_refreshed_ = false;
  bool few_moved_ = false;
  bool given_ = false;  // coordinates are given from outside
};

}  // namespace hinge::detail
