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
#include "hinge/engine/wide/tree/placed_row.hpp"
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
        found_((4 * parts_->rows() + 1) * simd::width),
        partner_(found_.size()),
        world_origin_(parts_->world_origin) {}

  const TreeParts<P>& parts() const noexcept { return *parts_; }
  const std::shared_ptr<const TreeParts<P>>& shared_parts() const noexcept { return parts_; }
  const TreeFrame& frame(std::uint32_t group) const noexcept { return frames_[group]; }
  const Vec3& world_origin() const noexcept { return world_origin_; }

  /// Brings frames and boxes up to date.
  void refresh(Placement<P>& placement) noexcept {
    if (update_ == placement.update_number()) return;
    const bool few = placement.few_moved();
    const std::vector<TreePart>& parts = parts_->parts;
    bool current = false, row_current = true;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const std::uint32_t group = parts[p].group;
      if (p == 0 || parts[p - 1].group != group) {
        const auto g = id<GroupId>(group);
        // Group 0 is the world.
        current = frame_at_[group] != 0 && (group == 0 || (few && placement.version(g) <= frame_at_[group]));
        frame_at_[group] = placement.update_number();
        if (!current) place(group, placement.frame(g));
      }
      if (!current) rows_[p / simd::width].set_frame(p % simd::width, float_frame_);
      row_current = row_current && current;
      if (p % simd::width != simd::width - 1 && p + 1 != parts.size()) continue;
      if (!row_current) rows_[p / simd::width].place(parts_->part_rows[p / simd::width]);
      row_current = true;
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

  /// visit(q, p) -> go on? for the tested pairs, q before p, whose boxes and balls come within margin(p) (tree unit).
  /// Many are listed before any is visited: how many each p has cannot be foretold.
  template <class Margin, class Visit>
  void sweep(const Margin& margin, const Visit& visit) {
    std::size_t n = 0;
    const auto hand_over = [&] {
      for (std::size_t k = 0; k < n; ++k)
        if (!visit(found_[k], partner_[k])) return false;
      n = 0;
      return true;
    };
    for (std::size_t p = 1; p < parts_->parts.size(); ++p) {
      if (n + p + simd::width > found_.size() && !hand_over()) return;
      const PlacedRow::Probe probe(rows_[p / simd::width], p % simd::width, margin(p));
      for (std::size_t r = 0; r * simd::width < p; ++r) {
        const simd::Bits tested = parts_->tested_with(p, r);
        if (tested == 0) continue;
        std::fill_n(partner_.data() + n, simd::width, static_cast<std::uint32_t>(p));
        n += simd::append_lanes(probe.near(rows_[r]) & tested, static_cast<std::uint32_t>(r * simd::width),
                                found_.data() + n);
      }
    }
    hand_over();
  }
  /// All parts whose boxes meet a box.
  std::span<const std::uint32_t> meeting(const FloatBox& box) noexcept {
    const BoxLanes probe(box);
    std::size_t n = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r)
      n += simd::append_lanes(overlapping(rows_[r].box, probe) & used(r), static_cast<std::uint32_t>(r * simd::width),
                              found_.data() + n);
    return {found_.data(), n};
  }

  /// Appends the parts before p that are tested with it, if their boxes are at most `bound` apart.
  void append_before(std::size_t p, float bound, std::vector<PartPair>& to) const {
    const FloatBox box = rows_[p / simd::width].box.get(p % simd::width);
    for (std::size_t r = 0; r * simd::width < p; ++r) append_near(r, parts_->tested_with(p, r), box, bound, p, to);
  }
  /// Appends all parts at most `bound` from a box; `second` is what they are paired with.
  void append_near(const FloatBox& box, float bound, std::size_t second, std::vector<PartPair>& to) const {
    for (std::size_t r = 0; r < rows_.size(); ++r) append_near(r, used(r), box, bound, second, to);
  }

 private:
  void place(std::uint32_t group, const Frame& frame) noexcept {
    frames_[group] = TreeFrame(frame, parts_->origin[group]);
    float* to = float_frame_.data();
    for (std::size_t k = 0; k < 3; ++k) simd::Double4(frame.column.data() + 4 * k).store_rounded(to + 4 * k);
    ((simd::Double4(frames_[group].middle.data()) -
      simd::Double4::of(world_origin_[0], world_origin_[1], world_origin_[2], 0.0)) *
     simd::Double4(parts_->scale))
        .store_rounded(to + 12);
  }

  void append_near(std::size_t r, simd::Bits lanes, const FloatBox& box, float bound, std::size_t second,
                   std::vector<PartPair>& to) const {
    using simd::Float16;
    if (lanes == 0) return;
    constexpr float down = 1.0F - 0x1p-20F;
    Float16 square(0.0F);
    for (std::size_t k = 0; k < 3; ++k) {
      const Float16 below = Float16(rows_[r].box.lower.data() + k * simd::width) - Float16(box.upper[k]);
      const Float16 above = Float16(box.lower[k]) - Float16(rows_[r].box.upper.data() + k * simd::width);
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
  std::vector<std::uint64_t> frame_at_;         // per group: the update its frame is of; 0: none
  std::vector<PlacedRow> rows_;                 // of parts
  PlacedRow::FloatFrame float_frame_;           // scratch: of the group placed last
  std::vector<std::uint32_t> found_, partner_;  // scratch: parts of pairs
  Vec3 world_origin_;
  std::uint64_t update_ = 0;
};

}  // namespace hinge
