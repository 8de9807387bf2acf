// SPDX-License-Identifier: BSD-3-Clause
// LeafPair: two leaves of two trees, the one's primitives brought into the other's frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hinge/engine/wide/tree/relative_turn.hpp"
#include "hinge/engine/wide/tree/tree_parts.hpp"
#include "hinge/primitive/leaf.hpp"

namespace hinge {

template <Primitive P>
class LeafPair {
 public:
  /// x and y are boxes of leaves; `turn` brings what is in `other` to `own`. `margin`: what counts as near beyond
  /// reaches, unit of own.
  [[gnu::always_inline]] LeafPair(const TreeParts<P>& own, BoxId x, const TreeParts<P>& other, BoxId y,
                                  const Turn& turn, float margin) noexcept
      : own_(own),
        leaf_(own.store.leaf(x)),
        other_leaf_(other.store.leaf(y)),
        near_{margin, turn.point_error, own.leaf_reach(leaf_), other.leaf_reach(other_leaf_)},
        turned_(other.leaf(other_leaf_), {turn.rotation, turn.size, turn.translation}) {
    // Reaches of the other tree are in its own unit.
    if (near_.other_reach != nullptr && turn.ratio != 1.0F) {
      for (std::size_t k = 0; k < simd::width; ++k) scaled_[k] = near_.other_reach[k] * turn.ratio;
      near_.other_reach = scaled_.data();
    }
    const TreeBox box = own.store.box(x);
    ones_ = turned_.near_box(box.middle, box.half, near_) & other.store.real[other_leaf_];
  }
  LeafPair(const LeafPair&) = delete;
  LeafPair& operator=(const LeafPair&) = delete;

  /// Lanes of the other leaf that may be near the own leaf's box.
  simd::Bits ones() const noexcept { return ones_; }
  std::uint32_t leaf() const noexcept { return leaf_; }
  std::uint32_t other_slot(std::size_t k) const noexcept {
    return static_cast<std::uint32_t>(other_leaf_ * simd::width + k);
  }
  const typename Leaf<P>::Turned& turned() const noexcept { return turned_; }
  const float* own() const noexcept { return own_.leaf(leaf_); }
  simd::Bits real() const noexcept { return own_.store.real[leaf_]; }
  const Nearness& nearness() const noexcept { return near_; }
  void set_margin(float margin) noexcept { near_.margin = margin; }

 private:
  const TreeParts<P>& own_;
  std::uint32_t leaf_, other_leaf_;
  simd::Bits ones_ = 0;
  Nearness near_;
  alignas(64) std::array<float, simd::width> scaled_;  // unless all reaches are 0 or in the same unit
  typename Leaf<P>::Turned turned_;
};

}  // namespace hinge
