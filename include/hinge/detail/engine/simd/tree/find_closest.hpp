// SPDX-License-Identifier: BSD-3-Clause
// ClosestFinder: traverses two trees nearest boxes first and collects the pairs that may be closest.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "hinge/detail/core/function_ref.hpp"
#include "hinge/detail/engine/simd/tree/leaf_pair.hpp"
#include "hinge/detail/engine/simd/tree/relative_transform.hpp"
#include "hinge/detail/engine/simd/tree/tree_parts.hpp"
#include "hinge/detail/primitive/triangle_pairs.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// Squared lower bounds of d - M between the boxes of a node and a box; 0 if boxes overlap. turned: the box after
/// `turn`.
[[gnu::always_inline]] inline simd::Float16 squared_gaps(const TreeNode& node, const TreeBox& box,
                                                         const TreeBox& turned, const Turn& turn) noexcept {
  using simd::Float16;
  constexpr std::size_t n = simd::width;
  const Float16 zero(0.0F);
  std::array<Float16, 3> d, half;
  Float16 first = zero, second = zero;
  for (std::size_t k = 0; k < 3; ++k) {
    d[k] = Float16(node.middle.data() + k * n) - Float16(turned.middle[k]);
    half[k] = Float16(node.half.data() + k * n);
    const Float16 gap = max(abs(d[k]) - (half[k] + Float16(turned.half[k] + turn.box_error)), zero);
    first = first + gap * gap;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Float16 along = d[0] * Float16(turn.rotation[4 * k]) + d[1] * Float16(turn.rotation[4 * k + 1]) +
                          d[2] * Float16(turn.rotation[4 * k + 2]);
    const Float16 reach = half[0] * Float16(turn.size[4 * k]) + half[1] * Float16(turn.size[4 * k + 1]) +
                          half[2] * Float16(turn.size[4 * k + 2]);
    const Float16 gap =
        max(abs(along) - (reach + Float16(turn.ratio * (turn.ratio * box.half[k] + turn.box_error))), zero);
    second = second + gap * gap;
  }
  // The rotated axes of the box have the length `ratio`.
  const float unit = 1.0F / (turn.ratio * turn.ratio);
  return max(first, second * Float16(unit)) * Float16(1.0F - 0x1p-20F);
}

/// Scratch memory of a traversal. `bound`: largest d - M of interest, without extra clearances, in the unit of tree a.
template <Primitive P>
class ClosestFinder {
 public:
  void reserve(std::size_t depth) {
    const std::size_t room = (depth + 2) * simd::width;
    if (room > stack_.size()) stack_.resize(room);
  }

  using Slots = std::array<std::uint32_t, simd::width>;
  /// Takes slots of a, slots of b, their number, and bounds of their distances; returns the new bound.
  using Flush = FunctionRef<float(const Slots&, const Slots&, std::size_t, const Bounds16&)>;

  /// Calls flush for up to sixteen pairs of primitives at a time.
  float run(const TreeParts<P>& a, const TreePart& part_a, const TreeParts<P>& b, const TreePart& part_b,
            const RelativeTransform& turn, float bound, QueryCounts& counts, Flush flush) {
    constexpr auto width = static_cast<std::uint32_t>(simd::width);
    std::size_t left = 0;
    queued_ = 0;
    stack_[left++] = {part_a.root, part_b.root, 0.0F};
    while (left != 0) {
      const Entry entry = stack_[--left];
      if (bound >= 0.0F && entry.squared > bound * bound) continue;
      const bool a_leaf = a.store.is_leaf(entry.a), b_leaf = b.store.is_leaf(entry.b);
      if (a_leaf && b_leaf) {
        bound = run_leaves(a, entry.a, b, entry.b, turn, bound, counts, flush);
        continue;
      }
      ++counts.boxes_tested;
      if (b_leaf || (!a_leaf && a.store.size(entry.a) >= b.store.size(entry.b) * turn.b_to_a.ratio)) {
        const std::uint32_t node = a.store.child(entry.a);
        const TreeBox box = b.store.box(entry.b);
        left = push(a.store.nodes[node], box, turn.b_to_a, bound, 1.0F, left, [&](std::uint32_t lane, float squared) {
          return Entry{node * width + lane, entry.b, squared};
        });
      } else {
        const std::uint32_t node = b.store.child(entry.b);
        const TreeBox box = a.store.box(entry.a);
        left = push(b.store.nodes[node], box, turn.a_to_b, bound / turn.b_to_a.ratio, turn.b_to_a.ratio, left,
                    [&](std::uint32_t lane, float squared) {
                      return Entry{entry.a, node * width + lane, squared};
                    });
      }
    }
    if (queued_ != 0) bound = hand_over(bound, turn.sane, flush);
    return bound;
  }

 private:
  struct Entry {
    BoxId a, b;
    float squared;  // lower bound, unit of a
  };

  /// Pushes the children that may be within the bound, farthest first, so that the nearest is popped next.
  template <class Make>
  [[gnu::always_inline]] std::size_t push(const TreeNode& node, const TreeBox& box, const Turn& turn, float bound,
                                          float to_a, std::size_t left, const Make& make) noexcept {
    const TreeBox turned = turn(box);
    const simd::Float16 squared = squared_gaps(node, box, turned, turn);
    // A negative bound asks for deeper penetration: the boxes must overlap by this depth.
    simd::Bits lanes = bound < 0.0F ? near_lanes(node, BoxProbe(box, turn, bound), turn)
                                    : ~less(simd::Float16(bound * bound), squared) & node.used;
    alignas(64) std::array<float, simd::width> each;
    squared.store(each.data());
    const std::size_t first = left;
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
      const Entry entry = make(lane, each[lane] * to_a * to_a);
      std::size_t place = left++;
      for (; place > first && stack_[place - 1].squared < entry.squared; --place) stack_[place] = stack_[place - 1];
      stack_[place] = entry;
    }
    return left;
  }

  float run_leaves(const TreeParts<P>& a, BoxId x, const TreeParts<P>& b, BoxId y, const RelativeTransform& turn,
                   float bound, QueryCounts& counts, Flush flush) {
    const TransformedLeaf<P> turned(b, y, turn.b_to_a);
    LeafPair<P> pair(a, x, turned, bound);
    for (simd::Bits ones = pair.ones(); ones != 0; ones &= ones - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(ones));
      ++counts.pairs_tested;
      pair.set_margin(bound);
      simd::Bits lanes =
          turn.sane ? pair.turned().roughly_near(k, pair.own(), pair.real(), pair.nearness()) : pair.real();
      for (; lanes != 0; lanes &= lanes - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
        slot_a_[queued_] = static_cast<std::uint32_t>(pair.leaf() * simd::width + i);
        slot_b_[queued_] = pair.other_slot(k);
        queue_.set(queued_, pair.own(), i, pair.turned(), k, turn.b_to_a.point_error);
        if (++queued_ == simd::width) bound = hand_over(bound, turn.sane, flush);
      }
    }
    return bound;
  }

  float hand_over(float bound, bool sane, Flush flush) {
    Bounds16 bounds;
    queue_.bound(bounds);
    if (!sane) {
      bounds.lower.fill(0.0F);
      bounds.upper.fill(std::numeric_limits<float>::infinity());
    }
    const std::size_t queued = queued_;
    queued_ = 0;
    return std::min(bound, flush(slot_a_, slot_b_, queued, bounds));
  }

  std::vector<Entry> stack_;
  TrianglePairs queue_;
  Slots slot_a_{}, slot_b_{};
  std::size_t queued_ = 0;
};

}  // namespace hinge::detail
