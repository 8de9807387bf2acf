// SPDX-License-Identifier: BSD-3-Clause
// PlacedParts: the world boxes of a set of tree parts, and the sweep for pairs that may be near.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/tree/admitted_pairs.hpp"
#include "hinge/detail/engine/simd/tree/part_set.hpp"
#include "hinge/detail/engine/simd/tree/placed_row.hpp"
#include "hinge/detail/simd/gather_bits.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// Two tree parts and a lower bound of the gap between their boxes, tree unit.
struct PartPair {
  float gap;
  std::uint32_t first, second;
};

/// Refers to the set.
class PlacedParts {
 public:
  explicit PlacedParts(const PartSet& set)
      : set_(&set), rows_(set.rows.size()), found_((4 * set.rows.size() + 1) * simd::width), partner_(found_.size()) {}

  const PartSet& set() const noexcept { return *set_; }
  std::size_t row_count() const noexcept { return rows_.size(); }

  /// Updates the boxes. Per group: its frame, and the update that last changed it. `update`: the present update.
  void refresh(std::span<const PlacedRow::FloatFrame> frames, std::span<const std::uint64_t> changed_at,
               std::uint64_t update) noexcept {
    if (at_ == update) return;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const std::size_t first = r * simd::width, last = std::min(first + simd::width, set_->size());
      bool stale = false;
      for (std::size_t p = first; p < last; ++p) {
        const std::uint32_t group = set_->parts[p].group;
        if (changed_at[group] <= at_) continue;
        rows_[r].set_frame(p - first, frames[group]);
        stale = true;
      }
      if (stale) rows_[r].place(set_->rows[r]);
    }
    at_ = update;
  }

  /// Calls visit(q, p) -> bool for the tested pairs, q before p, whose boxes and balls come within margin(p) (tree
  /// unit). Many pairs are listed before any is visited: the number per p is unpredictable.
  template <class Margin, class Visit>
  void sweep(const Margin& margin, const Visit& visit) {
    std::size_t n = 0;
    const auto hand_over = [&] {
      for (std::size_t k = 0; k < n; ++k)
        if (!visit(found_[k], partner_[k])) return false;
      n = 0;
      return true;
    };
    for (std::size_t p = 1; p < set_->size(); ++p) {
      if (n + p + simd::width > found_.size() && !hand_over()) return;
      const PlacedRow::Probe probe(rows_[p / simd::width], p % simd::width, margin(p));
      const AdmittedPairs::Row earlier = set_->tested.of(p);
      for (std::size_t r = 0; r * simd::width < p; ++r) {
        const simd::Bits tested = earlier.get(r);
        if (tested == 0) continue;
        std::fill_n(partner_.data() + n, simd::width, static_cast<std::uint32_t>(p));
        n += simd::append_lanes(probe.near(rows_[r]) & tested, static_cast<std::uint32_t>(r * simd::width),
                                found_.data() + n);
      }
    }
    hand_over();
  }
  /// All tree parts whose boxes overlap `box`. Valid until the next sweep or call.
  std::span<const std::uint32_t> meeting(const FloatBox& box) noexcept {
    const BoxLanes probe(box);
    std::size_t n = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r)
      n += simd::append_lanes(overlapping(rows_[r].box, probe) & set_->used(r),
                              static_cast<std::uint32_t>(r * simd::width), found_.data() + n);
    return {found_.data(), n};
  }

  /// Appends the parts before p that are tested with p, if their boxes are at most `bound` apart.
  void append_before(std::size_t p, float bound, std::vector<PartPair>& to) const {
    const FloatBox box = rows_[p / simd::width].box.get(p % simd::width);
    const AdmittedPairs::Row earlier = set_->tested.of(p);
    for (std::size_t r = 0; r * simd::width < p; ++r) append_near(r, earlier.get(r), box, bound, p, to);
  }
  /// Appends all parts at most `bound` from `box`, each paired with `second`.
  void append_near(const FloatBox& box, float bound, std::size_t second, std::vector<PartPair>& to) const {
    for (std::size_t r = 0; r < rows_.size(); ++r) append_near(r, set_->used(r), box, bound, second, to);
  }

 private:
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

  const PartSet* set_;
  std::vector<PlacedRow> rows_;
  std::vector<std::uint32_t> found_, partner_;  // scratch: tree parts of pairs
  std::uint64_t at_ = 0;
};

}  // namespace hinge::detail
