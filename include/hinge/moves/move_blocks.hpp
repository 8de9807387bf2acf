// SPDX-License-Identifier: BSD-3-Clause
// MoveBlocks: float coordinates of engine/wide's blocks, turned by a move as rigid bodies, and turned back for nothing.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/bounds/float_box.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/engine/wide/block_layout.hpp"
#include "hinge/engine/wide/float_turn.hpp"
#include "hinge/engine/wide/threshold_classes.hpp"
#include "hinge/engine/wide/unit_boxes.hpp"
#include "hinge/engine/wide/wide_state.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/moves/moving_parts.hpp"
#include "hinge/primitive/batch.hpp"
#include "hinge/query/query_options.hpp"
#include "hinge/simd/lanes.hpp"

namespace hinge {

/// x -> R x + t for the floats of blocks.
struct FloatMotion {
  FloatMotion() = default;
  FloatMotion(const Pose& motion, const Vec3& origin, double scale) noexcept {
    const Vec3 moved = (motion * origin - origin) * scale;
    for (std::size_t k = 0; k < 9; ++k) rotation[k] = static_cast<float>(motion.rotation.data()[k]);
    for (std::size_t k = 0; k < 3; ++k) translation[k] = static_cast<float>(moved[static_cast<Eigen::Index>(k)]);
  }
  std::array<float, 9> rotation{};
  std::array<float, 3> translation{};
};

/// Every block has two places: one holds its coordinates, a move writes those after it to the other. A block that is
/// hidden is found by no sweep.
template <Primitive P>
class MoveBlocks {
 public:
  /// After so many moves coordinates are placed in double again: rounding adds up.
  static constexpr unsigned most_turns = 16;

  MoveBlocks(std::shared_ptr<const WideParts<P>> wide, const MovingParts& parts)
      : wide_(std::move(wide)),
        floats_(2 * wide_->layout.block_count() * Batch<P>::floats),
        class_(floats_.size()),
        box_(2 * wide_->layout.block_count()),
        turns_(2 * wide_->layout.block_count(), 0),
        boxes_(wide_->layout.block_count()) {
    constexpr std::size_t n = Batch<P>::floats;
    for (std::size_t place = 0; place < box_.size(); ++place)
      std::copy_n(wide_->position_class.data() + place / 2 * n, n, class_.data() + place * n);
    for (std::uint32_t b = 0; b < layout().block_count(); ++b) {
      at_.push_back(2 * b);
      group_place_.push_back(parts.place(layout().groups_of(layout().blocks[b]).front()));
    }
    for (const std::uint32_t g : wide_->mixed_group) mixed_place_.push_back(parts.place(id<GroupId>(g)));
    double away = 0.0;
    for (const double x : layout().origin) away += 2.0 * std::abs(x);
    rounding_size_ = layout().scale * (4.0 * wide_->rigid.largest_local + away);
  }

  const BlockLayout& layout() const noexcept { return wide_->layout; }
  float reach(std::uint32_t b) const noexcept { return wide_->rigid.reach[b]; }
  float largest_reach() const noexcept { return wide_->rigid.largest_reach; }

  // What run_tasks asks for.
  const float* packed() const noexcept { return floats_.data(); }
  const std::uint8_t* position_class() const noexcept { return class_.data(); }
  static constexpr bool has_extra() noexcept { return false; }
  static constexpr float extra(std::size_t) noexcept { return 0.0F; }

  std::uint32_t at(std::uint32_t b) const noexcept { return at_[b]; }
  std::uint32_t position(std::uint32_t b) const noexcept {
    return at_[b] * static_cast<std::uint32_t>(Batch<P>::floats);
  }
  /// The primitive whose floats start at a position.
  std::uint32_t primitive(std::uint32_t position) const noexcept {
    constexpr auto floats = static_cast<std::uint32_t>(Batch<P>::floats), n = static_cast<std::uint32_t>(simd::width);
    return layout().primitive[position / floats / 2 * n + position % floats];
  }
  const float* floats(std::uint32_t b) const noexcept { return floats_.data() + position(b); }
  /// Grown by the block's reach.
  const FloatBox& box(std::uint32_t b) const noexcept { return box_[at_[b]]; }

  /// Places a block in double. frames: by places of MovingParts.
  void place(std::uint32_t b, std::span<const Frame> frames) noexcept {
    float* to = floats_.data() + position(b);
    FloatBox box;
    if (layout().blocks[b].rigid) {
      const FloatTurn turn(frames[group_place_[b]], layout().origin, layout().scale);
      box = Batch<P>::turn(wide_->rigid.offsets.data() + b * Batch<P>::floats, turn.rotation(),
                           turn(wide_->rigid.block[b].middle), to);
    } else {
      const std::uint32_t first = wide_->mixed_slot[b];
      box = Batch<P>::place(to, wide_->mixed.data() + first, mixed_place_.data() + first, frames, layout().origin,
                            layout().scale);
    }
    box_[at_[b]] = box.grown(reach(b));
    turns_[at_[b]] = 0;
    see(b);
  }

  /// Turns a block into its other place.
  void turn(std::uint32_t b, const FloatMotion& by) noexcept {
    const std::uint32_t from = at_[b];
    at_[b] ^= 1U;
    box_[at_[b]] = Batch<P>::turn(floats_.data() + from * Batch<P>::floats, by.rotation, by.translation,
                                  floats_.data() + position(b))
                       .grown(reach(b));
    turns_[at_[b]] = static_cast<std::uint8_t>(turns_[from] + 1);
    see(b);
  }
  /// The same where lanes belong to different parts; motions: by part, that of part 0 is not looked at.
  void turn(std::uint32_t b, std::span<const std::uint32_t> lane_parts, std::span<const FloatMotion> motions) noexcept {
    const float* from = floats_.data() + position(b);
    turns_[at_[b] ^ 1U] = static_cast<std::uint8_t>(turns_[at_[b]] + 1);
    at_[b] ^= 1U;
    float* to = floats_.data() + position(b);
    alignas(64) std::array<float, Batch<P>::floats> turned;
    simd::Bits left = simd::all_bits;
    while (left != 0) {
      const std::uint32_t part = lane_parts[static_cast<std::size_t>(std::countr_zero(left))];
      const float* source = from;
      if (part != 0) {
        Batch<P>::turn(from, motions[part].rotation, motions[part].translation, turned.data());
        source = turned.data();
      }
      for (std::size_t lane = 0; lane < simd::width; ++lane) {
        if (lane_parts[lane] != part) continue;
        for (std::size_t k = lane; k < Batch<P>::floats; k += simd::width) to[k] = source[k];
        left &= ~(simd::Bits{1} << lane);
      }
    }
    box_[at_[b]] = Batch<P>::hull(to).grown(reach(b));
    see(b);
  }
  /// Back to the place before the move.
  void turn_back(std::uint32_t b) noexcept { at_[b] ^= 1U; }
  bool is_worn(std::uint32_t b) const noexcept { return turns_[at_[b]] >= most_turns; }

  void hide(std::uint32_t b) noexcept { boxes_.set(b, FloatBox{}); }
  void show(std::uint32_t b) noexcept { boxes_.set(b, box(b)); }
  /// To be called for one block of each row after blocks were shown, before the next sweep.
  void cover(std::uint32_t b) noexcept { boxes_.cover(b); }
  std::span<const std::uint32_t> sweep(const FloatBox& box, QueryCounts& counts) noexcept {
    return boxes_.sweep(box, layout().block_count(), counts);
  }

  /// Largest magnitude of a coordinate met so far, reaches included, scaled, rounded up; infinite when floats cannot
  /// hold it.
  float extent() const noexcept { return extent_; }
  /// Coordinates may be looked at afresh: all blocks are placed after this.
  void forget_extent() noexcept { extent_ = 0.0F; }
  /// Moves that were taken back met nothing.
  void restore_extent(float extent) noexcept { extent_ = extent; }

  /// How far distances of turned floats may be off, scaled; motion_error: model unit. docs/explanation/moves.md
  /// derives it.
  double band(double largest, double motion_error) const noexcept {
    constexpr double u = 0x1p-24, v = 0x1p-53, underflow = 0x1p-60;
    const auto extent = static_cast<double>(extent_), half = static_cast<double>(wide_->rigid.largest_half);
    const double placed =
        6 * u * (2 * extent + 10 * half) + 8 * u * largest + 16 * v * (extent + rounding_size_) + underflow;
    return placed + most_turns * (42 * u * extent + 2 * motion_error * layout().scale + underflow);
  }

 private:
  void see(std::uint32_t b) noexcept {
    const float extent = box(b).extent();
    if (extent <= extent_) [[likely]]
      return;
    // A quarter more, to a power of two, so that what depends on it changes rarely. Not a number is too much, too.
    int exponent = 0;
    std::frexp(1.25F * extent, &exponent);
    extent_ =
        extent < largest_sane_coordinate / 2 ? std::ldexp(1.0F, exponent) : std::numeric_limits<float>::infinity();
  }

  std::shared_ptr<const WideParts<P>> wide_;
  simd::AlignedVector<float> floats_;
  std::vector<std::uint8_t> class_;         // where the floats of a primitive start
  std::vector<FloatBox> box_;               // per place
  std::vector<std::uint8_t> turns_;         // per place: since it was placed in double
  std::vector<std::uint32_t> at_;           // per block: which of its places
  std::vector<std::uint32_t> group_place_;  // per block: of its first group
  std::vector<std::uint32_t> mixed_place_;  // where WideParts has mixed_group
  UnitBoxes boxes_;                         // of the blocks that are shown
  double rounding_size_ = 0.0;
  float extent_ = 0.0F;
};

}  // namespace hinge
