// SPDX-License-Identifier: BSD-3-Clause
// MoveBlocks: float coordinates of engine/simd's blocks, moved as rigid bodies; double-buffered, so rejecting is free.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/block_layout.hpp"
#include "hinge/detail/engine/simd/entry_boxes.hpp"
#include "hinge/detail/engine/simd/float_transform.hpp"
#include "hinge/detail/engine/simd/placed_blocks.hpp"
#include "hinge/detail/engine/simd/threshold_classes.hpp"
#include "hinge/detail/kinematics/compose_frames.hpp"
#include "hinge/detail/moves/moved_blocks.hpp"
#include "hinge/detail/moves/moving_parts.hpp"
#include "hinge/detail/primitive/batch.hpp"
#include "hinge/detail/simd/gather_bits.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// A rigid motion x -> R x + t for the scaled floats of blocks.
struct FloatMotion {
  FloatMotion() = default;
  FloatMotion(const Frame& motion, const Vec3& origin, double scale) noexcept {
    std::array<double, 4> moved;
    FrameColumns(motion).place(origin[0], origin[1], origin[2]).store(moved.data());
    for (std::size_t k = 0; k < 9; ++k) rotation[k] = static_cast<float>(motion.column[k / 3 * 4 + k % 3]);
    for (std::size_t k = 0; k < 3; ++k)
      translation[k] = static_cast<float>((moved[k] - origin[static_cast<Eigen::Index>(k)]) * scale);
  }
  std::array<float, 9> rotation{};
  std::array<float, 3> translation{};
};

/// Every block has two buffers: a move writes the new coordinates to the unused one. Sweeps test the blocks at rest,
/// and the moved blocks in the order in which they moved.
template <Primitive P>
class MoveBlocks {
 public:
  /// Number of moves after which coordinates are placed in double again: rounding adds up.
  static constexpr unsigned most_turns = 16;

  /// order: see MovedBlocks::order().
  MoveBlocks(std::shared_ptr<const SimdParts<P>> parts_of_model, const SelectedModel<P>& model,
             const MovingParts& parts, std::span<const std::uint32_t> order)
      : simd_parts_(std::move(parts_of_model)),
        floats_(2 * simd_parts_->layout.block_count() * Batch<P>::floats),
        class_(floats_.size()),
        box_(2 * simd_parts_->layout.block_count()),
        turns_(2 * simd_parts_->layout.block_count(), 0),
        order_(order.begin(), order.end()),
        rank_(order.size()),
        boxes_(simd_parts_->layout.block_count()),
        standing_(simd_parts_->layout.block_count()),
        turned_boxes_(simd_parts_->layout.block_count()) {
    constexpr std::size_t n = Batch<P>::floats;
    for (std::size_t place = 0; place < box_.size(); ++place) {
      std::copy_n(simd_parts_->position_class.data() + place / 2 * n, n, class_.data() + place * n);
      set_radii<P>(floats_.data() + place * n, layout().members(place / 2), model.primitives(), layout().scale);
    }
    for (std::uint32_t b = 0; b < layout().block_count(); ++b) {
      at_.push_back(2 * b);
      group_place_.push_back(parts.place(layout().groups_of(layout().blocks[b]).front()));
    }
    for (std::uint32_t r = 0; r < rank_.size(); ++r) rank_[order_[r]] = r;
    for (const std::uint32_t g : simd_parts_->mixed_group) mixed_place_.push_back(parts.place(id<GroupId>(g)));
    double away = 0.0;
    for (const double x : layout().origin) away += 2.0 * std::abs(x);
    rounding_size_ = layout().scale * (4.0 * simd_parts_->rigid.largest_local + away);
  }

  const BlockLayout& layout() const noexcept { return simd_parts_->layout; }
  float reach(std::uint32_t b) const noexcept { return simd_parts_->rigid.reach[b]; }
  float largest_reach() const noexcept { return simd_parts_->rigid.largest_reach; }

  // The interface of NarrowPhase.
  const float* packed() const noexcept { return floats_.data(); }
  const std::uint8_t* position_class() const noexcept { return class_.data(); }
  static constexpr bool has_extra() noexcept { return false; }
  static constexpr float extra_at(std::size_t) noexcept { return 0.0F; }

  /// The block's present buffer, numbered over all blocks.
  std::uint32_t at(std::uint32_t b) const noexcept { return at_[b]; }
  std::uint32_t position(std::uint32_t b) const noexcept {
    return at_[b] * static_cast<std::uint32_t>(Batch<P>::floats);
  }
  /// The slot, in BlockLayout::primitive, whose floats start at `position`.
  static std::uint32_t slot(std::uint32_t position) noexcept {
    constexpr auto floats = static_cast<std::uint32_t>(Batch<P>::floats), n = static_cast<std::uint32_t>(simd::width);
    return position / floats / 2 * n + position % floats;
  }
  PrimitiveId primitive_of_slot(std::uint32_t slot) const noexcept { return id<PrimitiveId>(layout().primitive[slot]); }
  const float* floats(std::uint32_t b) const noexcept { return floats_.data() + position(b); }
  /// Present position of a slot's floats.
  std::uint32_t position_of_slot(std::uint32_t slot) const noexcept {
    constexpr auto n = static_cast<std::uint32_t>(simd::width);
    return position(slot / n) + slot % n;
  }
  /// The block's box, inflated by its reach.
  const FloatBox& box(std::uint32_t b) const noexcept { return box_[at_[b]]; }

  /// Places a block in double. frames: indexed by place in MovingParts.
  void place(std::uint32_t b, std::span<const Frame> frames) noexcept {
    float* to = floats_.data() + position(b);
    FloatBox box;
    if (layout().blocks[b].rigid) {
      const FloatTransform turn(frames[group_place_[b]], layout().origin, layout().scale);
      box = Batch<P>::turn(simd_parts_->rigid.offsets.data() + b * Batch<P>::floats, turn.rotation(),
                           turn(simd_parts_->rigid.block[b].middle), to);
    } else {
      const std::uint32_t first = simd_parts_->mixed_slot[b];
      box = Batch<P>::place(to, simd_parts_->mixed.data() + first, mixed_place_.data() + first, frames, layout().origin,
                            layout().scale);
    }
    box_[at_[b]] = box.grown(reach(b));
    turns_[at_[b]] = 0;
    boxes_.set(rank_[b], box_[at_[b]]);
    see(b);
  }

  std::uint32_t block(std::uint32_t rank) const noexcept { return order_[rank]; }
  std::uint32_t rank(std::uint32_t b) const noexcept { return rank_[b]; }
  std::span<const std::uint32_t> ranks() const noexcept { return rank_; }
  /// Hides blocks of ranks begin .. end - 1, which are about to move, from sweeps of the blocks at rest.
  void hide(std::uint32_t begin, std::uint32_t end) noexcept { standing_.hide(begin, end); }
  /// Moves a block into its other buffer.
  void turn(std::uint32_t b, const FloatMotion& by) noexcept {
    const float* from = floats(b);
    at_[b] ^= 1U;
    finish(b, Batch<P>::turn(from, by.rotation, by.translation, floats_.data() + position(b)));
  }
  /// The same for a block whose lanes belong to different parts. motions: per part; that of part 0 is not used.
  void turn(std::uint32_t b, std::span<const PartLanes> pieces, std::span<const FloatMotion> motions) noexcept {
    using simd::Float16;
    constexpr std::size_t rows = Batch<P>::floats / simd::width;
    const float* from = floats(b);
    at_[b] ^= 1U;
    float* to = floats_.data() + position(b);
    std::array<Float16, rows> all;
    for (std::size_t k = 0; k < rows; ++k) all[k] = Float16(from + k * simd::width);
    for (const auto& [part, lanes] : pieces) {
      if (part == 0) continue;
      alignas(64) std::array<float, Batch<P>::floats> turned;
      Batch<P>::turn(from, motions[part].rotation, motions[part].translation, turned.data());
      for (std::size_t k = 0; k < rows; ++k)
        all[k] = simd::choose(lanes, Float16(turned.data() + k * simd::width), all[k]);
    }
    for (std::size_t k = 0; k < rows; ++k) all[k].store(to + k * simd::width);
    finish(b, Batch<P>::hull(to));
  }
  /// Blocks moved by the present move, in order.
  std::span<const std::uint32_t> turned() const noexcept { return turned_; }
  /// Drops the move: switches back to the old buffers.
  void turn_back() noexcept {
    for (const std::uint32_t b : turned_) at_[b] ^= 1U;
    forget_turned();
  }
  /// Accepts the move, which must have moved all hidden blocks. Returns true if a block reached most_turns: the caller
  /// must place all worn blocks again.
  bool keep() noexcept {
    unsigned most = 0;
    for (const std::uint32_t b : turned_) {
      boxes_.set(rank_[b], box(b));
      most = std::max<unsigned>(most, turns_[at_[b]]);
    }
    if (boxes_.rows() > simd::width) {  // there are levels above the rows
      std::size_t row = boxes_.rows();
      for (const std::uint32_t b : turned_)
        if (std::exchange(row, rank_[b] / simd::width) != rank_[b] / simd::width) boxes_.cover(rank_[b]);
    }
    forget_turned();
    return most >= most_turns;
  }
  /// True if the block was moved at least half of most_turns times.
  bool is_worn(std::uint32_t b) const noexcept { return 2 * turns_[at_[b]] >= most_turns; }

  /// Call this after place(), before the next sweep.
  void cover_all() noexcept {
    for (std::size_t b = 0; b < layout().block_count(); b += simd::width) boxes_.cover(b);
  }

  /// Ranks of the blocks at rest whose boxes overlap `box`, in order. Valid until the next sweep.
  std::span<const std::uint32_t> standing(const FloatBox& box, QueryCounts& counts) noexcept {
    return boxes_.sweep(box, standing_, counts);
  }
  /// The same for the first `end` moved blocks: their indices in turned().
  std::span<const std::uint32_t> turned(const FloatBox& box, std::size_t end, QueryCounts& counts) noexcept {
    return turned_boxes_.sweep(box, end, counts);
  }

  /// Largest coordinate magnitude so far, reaches included, scaled, rounded up; infinite if floats cannot hold it.
  float extent() const noexcept { return extent_; }
  /// Resets extent(). The caller must place all blocks after this.
  void forget_extent() noexcept { extent_ = 0.0F; }
  /// Restores extent() after a move whose coordinates floats cannot hold.
  void restore_extent(float extent) noexcept { extent_ = extent; }

  /// Bound of the error of distances between moved floats, scaled. motion_error: model unit. Derivation:
  /// docs/explanation/moves.md.
  double band(double largest, double motion_error) const noexcept {
    constexpr double u = 0x1p-24, v = 0x1p-53, underflow = 0x1p-60;
    const auto extent = static_cast<double>(extent_), half = static_cast<double>(simd_parts_->rigid.largest_half);
    const double placed = 6 * u * (2 * extent + 10 * half) + Batch<P>::slack * u * extent + 8 * u * largest +
                          16 * v * (extent + rounding_size_) + underflow;
    return placed + most_turns * (42 * u * extent + 2 * motion_error * layout().scale + underflow);
  }

 private:
  /// Stores the box of a block that was moved into its present buffer.
  void finish(std::uint32_t b, const FloatBox& around) noexcept {
    const std::uint32_t at = at_[b];
    box_[at] = around.grown(reach(b));
    turns_[at] = static_cast<std::uint8_t>(turns_[at ^ 1U] + 1);
    turned_boxes_.set(turned_.size(), box_[at]);
    turned_boxes_.close(turned_.size());
    turned_.push_back(b);
    see(b);
  }
  void forget_turned() noexcept {
    turned_.clear();
    standing_.show_all();
  }
  void see(std::uint32_t b) noexcept {
    const float extent = box(b).extent();
    if (extent <= extent_) [[likely]]
      return;
    // Round up to a power of two above 1.25 times the value, so that dependent values change rarely. NaN becomes
    // infinite.
    int exponent = 0;
    std::frexp(1.25F * extent, &exponent);
    extent_ =
        extent < largest_sane_coordinate / 2 ? std::ldexp(1.0F, exponent) : std::numeric_limits<float>::infinity();
  }

  std::shared_ptr<const SimdParts<P>> simd_parts_;
  simd::AlignedVector<float> floats_;
  std::vector<std::uint8_t> class_;         // class at the position of a primitive's floats
  std::vector<FloatBox> box_;               // per buffer
  std::vector<std::uint8_t> turns_;         // per buffer: moves since it was placed in double
  std::vector<std::uint32_t> at_;           // per block: its present buffer
  std::vector<std::uint32_t> group_place_;  // per block: place of its first group
  std::vector<std::uint32_t> mixed_place_;  // per entry of SimdParts::mixed_group: its place
  std::vector<std::uint32_t> order_, rank_;
  EntryBoxes boxes_;  // boxes of all blocks before the present move, by rank
  ShownEntries standing_;
  std::vector<std::uint32_t> turned_;
  EntryBoxes turned_boxes_;  // boxes of turned_
  double rounding_size_ = 0.0;
  float extent_ = 0.0F;
};

}  // namespace hinge::detail
