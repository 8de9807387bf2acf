// SPDX-License-Identifier: BSD-3-Clause
// RecentCollisions: the pairs that stopped recent moves; they often collide again.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hinge/detail/moves/move_blocks.hpp"
#include "hinge/detail/moves/moving_parts.hpp"
#include "hinge/detail/primitive/batch.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// Sixteen pairs of slots. A new pair replaces the pair whose last collision is oldest.
class RecentCollisions {
 public:
  using Pair = std::array<std::uint32_t, 2>;

  /// Returns a pair that surely collides after the move: it is below its threshold by more than the error of float
  /// coordinates. motions: per part of the cut. margin: at least the error of a distance, scaled.
  template <ComparesTwo P>
  std::optional<Pair> find(const MoveBlocks<P>& blocks, std::span<const FloatMotion> motions, float margin,
                           const MovingParts& parts) {
    for (simd::Bits left = apart(parts); left != 0; left &= left - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(left));
      const auto turned = [&](std::size_t side) {
        const typename Batch<P>::One one(blocks.packed() + blocks.position_of_slot(slot_[k][side]));
        const std::uint32_t part = parts.part_of(place_[side][k]);
        return part == 0 ? one : one.turned(motions[part].rotation, motions[part].translation);
      };
      const auto p = turned(0), q = turned(1);
      // One margin for the error of float coordinates, one for the rounding of this comparison.
      if (p.closer_than(q, threshold_[k] - 2.0F * margin) && std::max(p.extent(), q.extent()) <= blocks.extent()) {
        met_at_[k] = ++now_;
        return slot_[k];
      }
    }
    return {};
  }

  /// place: places of the two groups in MovingParts. threshold: scaled, rounded down.
  void add(const Pair& slot, const Pair& place, float threshold) noexcept {
    const auto end = slot_.begin() + static_cast<std::ptrdiff_t>(size_);
    auto k = static_cast<std::size_t>(std::find(slot_.begin(), end, slot) - slot_.begin());
    if (k == size_)
      k = size_ < simd::width
              ? size_++
              : static_cast<std::size_t>(std::min_element(met_at_.begin(), met_at_.end()) - met_at_.begin());
    slot_[k] = slot;
    threshold_[k] = threshold;
    for (std::size_t side = 0; side < 2; ++side) place_[side][k] = place[side];
    met_at_[k] = ++now_;
  }

 private:
  /// Bit k is set if the two primitives of pair k belong to different parts.
  simd::Bits apart(const MovingParts& parts) {
    of_part_.assign(parts.parts().size(), {});
    std::array<simd::Bits, 2> moving{};
    for (const MovingParts::Stretch& s : parts.stretches())
      for (std::size_t side = 0; side < 2; ++side) {
        const simd::Bits in = s.lanes(place_[side].data());
        of_part_[s.part][side] |= in;
        moving[side] |= in;
      }
    simd::Bits together = ~(moving[0] | moving[1]);
    for (const auto& [first, second] : of_part_) together |= first & second;
    return ~together & ((simd::Bits{1} << size_) - 1);
  }

  std::size_t size_ = 0;
  std::array<Pair, simd::width> slot_{};
  std::array<float, simd::width> threshold_{};
  std::array<std::array<std::uint32_t, simd::width>, 2> place_{};  // the layout that Stretch::lanes needs
  std::array<std::uint64_t, simd::width> met_at_{};
  std::uint64_t now_ = 0;
  std::vector<std::array<simd::Bits, 2>> of_part_;  // scratch
};

}  // namespace hinge::detail
