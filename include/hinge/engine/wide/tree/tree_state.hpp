// SPDX-License-Identifier: BSD-3-Clause
// TreeState: where the trees are now: their frames and world boxes, and the sweep for pairs of parts that may be near.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/bounds/float_box.hpp"
#include "hinge/core/id.hpp"
#include "hinge/engine/wide/float_turn.hpp"
#include "hinge/engine/wide/tree/relative_turn.hpp"
#include "hinge/engine/wide/tree/tree_parts.hpp"
#include "hinge/model/placement.hpp"
#include "hinge/simd/gather_bits.hpp"

namespace hinge {

/// Two parts and a lower bound of the gap between them, tree unit.
struct PartPair {
  float gap;
  std::uint32_t first, second;
};

template <Primitive P>
class TreeState {
 public:
  explicit TreeState(std::shared_ptr<const TreeParts<P>> parts)
      : parts_(std::move(parts)),
        frames_(parts_->origin.size()),
        frame_at_(parts_->origin.size(), 0),
        rows_(parts_->rows()),
        found_(parts_->rows() * simd::width + simd::width),
        world_origin_(parts_->world_origin) {}

  const TreeParts<P>& parts() const noexcept { return *parts_; }
  const std::shared_ptr<const TreeParts<P>>& shared_parts() const noexcept { return parts_; }
  const TreeFrame& frame(std::uint32_t group) const noexcept { return frames_[group]; }
  const Vec3& world_origin() const noexcept { return world_origin_; }

  /// Brings frames and boxes up to date.
  void refresh(Placement<P>& placement) noexcept {
    if (update_ == placement.update_number()) return;
    const bool few = placement.few_moved();
    for (std::size_t p = 0; p < parts_->parts.size(); ++p) {
      const TreePart& part = parts_->parts[p];
      const auto g = id<GroupId>(part.group);
      const bool first = p == 0 || parts_->parts[p - 1].group != part.group;
      if (first) {
        // Group 0 is the world.
        current_ =
            frame_at_[part.group] != 0 && (part.group == 0 || (few && placement.version(g) <= frame_at_[part.group]));
        frame_at_[part.group] = placement.update_number();
        if (!current_) frames_[part.group] = TreeFrame(placement.frame(g), parts_->origin[part.group]);
      }
      if (!current_) rows_[p / simd::width].set(p % simd::width, world_box(p, placement, world_origin_));
    }
    update_ = placement.update_number();
  }

  /// The world box of a part, reaches included, relative to some origin, in this model's tree unit.
  FloatBox world_box(std::size_t p, Placement<P>& placement, const Vec3& origin) const noexcept {
    // What turning, adding and rounding lose, as a share of the numbers involved.
    constexpr float rounding = 8 * 0x1p-24F;
    const TreePart& part = parts_->parts[p];
    const FloatBox box = FloatTurn(placement.frame(id<GroupId>(part.group)), origin, parts_->scale)(part.box);
    const float size = box.extent();
    return sane(box.grown(size < 0x1p100F ? size * rounding : 0.0F));
  }
  FloatBox box(std::size_t p) const noexcept { return rows_[p / simd::width].get(p % simd::width); }

  /// The parts before p that are tested with it and whose boxes, grown by `margin` (tree unit), meet its own; valid
  /// until the next call.
  std::span<const std::uint32_t> before(std::size_t p, float margin) noexcept {
    const BoxLanes probe(box(p).grown(margin));
    std::size_t n = 0;
    for (std::size_t r = 0; r * simd::width < p; ++r) {
      const simd::Bits tested = parts_->tested_with(p, r);
      if (tested == 0) continue;
      n += simd::append_lanes(overlapping(rows_[r], probe) & tested, static_cast<std::uint32_t>(r * simd::width),
                              found_.data() + n);
    }
    return {found_.data(), n};
  }
  /// All parts whose boxes meet a box.
  std::span<const std::uint32_t> meeting(const FloatBox& box) noexcept {
    const BoxLanes probe(box);
    std::size_t n = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r)
      n += simd::append_lanes(overlapping(rows_[r], probe) & used(r), static_cast<std::uint32_t>(r * simd::width),
                              found_.data() + n);
    return {found_.data(), n};
  }

  /// Appends the parts before p that are tested with it, if their boxes are at most `bound` apart.
  void append_before(std::size_t p, float bound, std::vector<PartPair>& to) const {
    for (std::size_t r = 0; r * simd::width < p; ++r) append_near(r, parts_->tested_with(p, r), box(p), bound, p, to);
  }
  /// Appends all parts at most `bound` from a box; `second` is what they are paired with.
  void append_near(const FloatBox& box, float bound, std::size_t second, std::vector<PartPair>& to) const {
    for (std::size_t r = 0; r < rows_.size(); ++r) append_near(r, used(r), box, bound, second, to);
  }

 private:
  void append_near(std::size_t r, simd::Bits lanes, const FloatBox& box, float bound, std::size_t second,
                   std::vector<PartPair>& to) const {
    using simd::Float16;
    if (lanes == 0) return;
    constexpr float down = 1.0F - 0x1p-20F;
    Float16 square(0.0F);
    for (std::size_t k = 0; k < 3; ++k) {
      const Float16 below = Float16(rows_[r].lower.data() + k * simd::width) - Float16(box.upper[k]);
      const Float16 above = Float16(box.lower[k]) - Float16(rows_[r].upper.data() + k * simd::width);
      const Float16 gap = max(max(below, above), Float16(0.0F));
      square = square + gap * gap;
    }
    alignas(64) std::array<float, simd::width> squares;
    square.store(squares.data());
    lanes &= ~less(Float16(bound < 0.0F ? 0.0F : bound * bound), square * Float16(down));
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(lanes));
      to.push_back({std::sqrt(squares[k]) * down, static_cast<std::uint32_t>(r * simd::width + k),
                    static_cast<std::uint32_t>(second)});
    }
  }
  simd::Bits used(std::size_t row) const noexcept {
    const std::size_t left = parts_->parts.size() - row * simd::width;
    return left >= simd::width ? simd::all_bits : (simd::Bits{1} << left) - 1;
  }

  std::shared_ptr<const TreeParts<P>> parts_;
  std::vector<TreeFrame> frames_;
  std::vector<std::uint64_t> frame_at_;  // per group: the update its frame is of; 0: none
  std::vector<BoxRow> rows_;             // of parts
  std::vector<std::uint32_t> found_;
  Vec3 world_origin_;
  std::uint64_t update_ = 0;
  bool current_ = false;
};

}  // namespace hinge
