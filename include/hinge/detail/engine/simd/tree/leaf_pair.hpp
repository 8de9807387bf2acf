// SPDX-License-Identifier: BSD-3-Clause
// TransformedLeaf: a leaf's primitives in another tree's frame. LeafPair: a TransformedLeaf and a leaf of that tree.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "hinge/detail/engine/simd/tree/relative_transform.hpp"
#include "hinge/detail/engine/simd/tree/tree_parts.hpp"
#include "hinge/detail/primitive/triangle_leaf.hpp"

namespace hinge::detail {

template <Primitive P>
class TransformedLeaf {
 public:
  /// y: the box of a leaf of `from`. turn: transform from that tree to the other tree.
  [[gnu::always_inline]] TransformedLeaf(const TreeParts<P>& from, BoxId y, const Turn& turn) noexcept
      : leaf_(from.store.leaf(y)),
        real_(from.store.real[leaf_]),
        error_(turn.point_error),
        reach_(from.leaf_reach(leaf_)),
        turned_(from.leaf(leaf_), {turn.rotation, turn.size, turn.translation}) {
    // Convert reaches from the unit of their own tree.
    if (reach_ != nullptr && turn.ratio != 1.0F) {
      for (std::size_t k = 0; k < simd::width; ++k) scaled_[k] = reach_[k] * turn.ratio;
      reach_ = scaled_.data();
    }
  }
  TransformedLeaf(const TransformedLeaf&) = delete;
  TransformedLeaf& operator=(const TransformedLeaf&) = delete;

  /// Lanes that may be within the margin of a box. The box includes the reaches of its contents.
  [[gnu::always_inline]] simd::Bits near_box(const TreeBox& box, float margin) const noexcept {
    return turned_.near_box(box.middle, box.half, Nearness{margin, error_, nullptr, reach_}) & real_;
  }
  simd::Bits real() const noexcept { return real_; }
  const float* reach() const noexcept { return reach_; }
  float error() const noexcept { return error_; }
  std::uint32_t slot(std::size_t k) const noexcept { return static_cast<std::uint32_t>(leaf_ * simd::width + k); }
  const TriangleLeaf::Turned& turned() const noexcept { return turned_; }

 private:
  std::uint32_t leaf_;
  simd::Bits real_;
  float error_;
  const float* reach_;
  alignas(64) std::array<float, simd::width> scaled_;  // used if reaches are above 0 and the units differ
  TriangleLeaf::Turned turned_;
};

template <Primitive P>
class LeafPair {
 public:
  /// x: the box of a leaf of `own`, the tree that `other` was transformed into. margin: added to the reaches, unit of
  /// own.
  [[gnu::always_inline]] LeafPair(const TreeParts<P>& own, BoxId x, const TransformedLeaf<P>& other,
                                  float margin) noexcept
      : own_(own),
        other_(other),
        leaf_(own.store.leaf(x)),
        ones_(other.near_box(own.store.box(x), margin)),
        near_{margin, other.error(), own.leaf_reach(leaf_), other.reach()} {}

  /// Lanes of the other leaf that may be near the box of the own leaf.
  simd::Bits ones() const noexcept { return ones_; }
  std::uint32_t leaf() const noexcept { return leaf_; }
  std::uint32_t other_slot(std::size_t k) const noexcept { return other_.slot(k); }
  const TriangleLeaf::Turned& turned() const noexcept { return other_.turned(); }
  const float* own() const noexcept { return own_.leaf(leaf_); }
  simd::Bits real() const noexcept { return own_.store.real[leaf_]; }
  const Nearness& nearness() const noexcept { return near_; }

  /// Returns those of the lanes `ones` of the other leaf that are within the margin along an axis of length <= 1 from
  /// the own tree to the other tree.
  [[gnu::flatten]] simd::Bits separate(const Axis<float>& axis, simd::Bits ones) noexcept {
    const float slack = near_.margin + std::abs(near_.margin) * 0x1p-20F + 1e-37F +
                        2.0F * near_.error * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
    simd::Float16 top = TriangleLeaf::top(own(), axis) + simd::Float16(slack);
    simd::Float16 bottom = -TriangleLeaf::top(turned().coordinates(), {-axis.x, -axis.y, -axis.z});
    constexpr float up = 1.0F + 0x1p-20F;
    if (near_.reach != nullptr) top = top + simd::Float16(near_.reach) * simd::Float16(up);
    if (near_.other_reach != nullptr) bottom = bottom - simd::Float16(near_.other_reach) * simd::Float16(up);
    top.store(top_.data());
    bottom.store(bottom_.data());
    return ones & ~less(simd::Float16(largest(top)), bottom);
  }
  /// After separate(): lanes of the own leaf that may be near lane k of the other leaf.
  [[gnu::always_inline]] simd::Bits lanes(std::size_t k) const noexcept {
    return real() & ~less(simd::Float16(top_.data()), simd::Float16(bottom_[k]));
  }
  /// After separate(): the lane of `ones` (not 0) that is nearest along the axis.
  std::size_t first_of(simd::Bits ones) const noexcept {
    auto best = static_cast<std::size_t>(std::countr_zero(ones));
    for (; ones != 0; ones &= ones - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(ones));
      if (bottom_[k] < bottom_[best]) best = k;
    }
    return best;
  }
  void set_margin(float margin) noexcept { near_.margin = margin; }

 private:
  const TreeParts<P>& own_;
  const TransformedLeaf<P>& other_;
  std::uint32_t leaf_;
  simd::Bits ones_;
  Nearness near_;
  alignas(64) std::array<float, simd::width> top_, bottom_;  // along the axis of separate()
};

}  // namespace hinge::detail
