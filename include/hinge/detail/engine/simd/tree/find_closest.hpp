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
/// `turn`. The bounds use the face axes of both boxes and `towards`, an axis from the node to the box of length <= 1.
[[gnu::always_inline]] inline simd::Float16 squared_gaps(const TreeNode& node, const TreeBox& box,
                                                         const TreeBox& turned, const Turn& turn,
                                                         const Axis<float>& towards) noexcept {
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
  float reach = 2.0F * turn.box_error;
  for (std::size_t k = 0; k < 3; ++k)
    reach += box.half[k] * std::abs(towards.x * turn.rotation[4 * k] + towards.y * turn.rotation[4 * k + 1] +
                                    towards.z * turn.rotation[4 * k + 2]);
  const Float16 apart = -(d[0] * Float16(towards.x) + d[1] * Float16(towards.y) + d[2] * Float16(towards.z)) -
                        (half[0] * Float16(std::abs(towards.x)) + half[1] * Float16(std::abs(towards.y)) +
                         half[2] * Float16(std::abs(towards.z)) + Float16(reach));
  const Float16 third = max(apart, zero);
  // The rotated axes of the box have the length `ratio`.
  const float unit = 1.0F / (turn.ratio * turn.ratio);
  return max(max(first, second * Float16(unit)), third * third) * Float16(1.0F - 0x1p-20F);
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
    least_upper_ = std::numeric_limits<float>::infinity();
    towards_ = {0.0F, 0.0F, 0.0F};
    const TreeBox box_b = turn.b_to_a(part_b.root_box), &box_a = part_a.root_box;
    set_towards(
        {box_b.middle[0] - box_a.middle[0], box_b.middle[1] - box_a.middle[1], box_b.middle[2] - box_a.middle[2]});
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
        left = push(a.store.nodes[node], box, turn.b_to_a, towards_, bound, 1.0F, left,
                    [&](std::uint32_t lane, float squared) {
                      return Entry{node * width + lane, entry.b, squared};
                    });
      } else {
        const std::uint32_t node = b.store.child(entry.b);
        const TreeBox box = a.store.box(entry.a);
        const std::array<float, 12>& r = turn.b_to_a.rotation;
        const float unit = -1.0F / turn.b_to_a.ratio;
        const Axis<float> back{unit * (r[0] * towards_.x + r[1] * towards_.y + r[2] * towards_.z),
                               unit * (r[4] * towards_.x + r[5] * towards_.y + r[6] * towards_.z),
                               unit * (r[8] * towards_.x + r[9] * towards_.y + r[10] * towards_.z)};
        left = push(b.store.nodes[node], box, turn.a_to_b, back, bound / turn.b_to_a.ratio, turn.b_to_a.ratio, left,
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
  [[gnu::always_inline]] std::size_t push(const TreeNode& node, const TreeBox& box, const Turn& turn,
                                          const Axis<float>& towards, float bound, float to_a, std::size_t left,
                                          const Make& make) noexcept {
    const TreeBox turned = turn(box);
    const simd::Float16 squared = squared_gaps(node, box, turned, turn, towards);
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
    simd::Bits ones = pair.ones();
    is_new_axis_ = turn.sane;
    while (ones != 0) {
      if (is_new_axis_) {
        is_new_axis_ = false;
        pair.set_margin(bound);
        ones = pair.separate(towards_, ones);
        if (ones == 0) break;
      }
      // The nearest lane first, as long as nothing is known.
      const bool is_first = turn.sane && least_upper_ == std::numeric_limits<float>::infinity();
      const std::size_t k = is_first ? pair.first_of(ones) : static_cast<std::size_t>(std::countr_zero(ones));
      ones &= ~(simd::Bits{1} << k);
      ++counts.pairs_tested;
      pair.set_margin(bound);
      simd::Bits lanes = pair.real();
      if (turn.sane) {
        lanes = pair.lanes(k);
        if (lanes == 0) continue;
        lanes = pair.turned().roughly_near(k, pair.own(), lanes, pair.nearness());
      }
      for (; lanes != 0; lanes &= lanes - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
        slot_a_[queued_] = static_cast<std::uint32_t>(pair.leaf() * simd::width + i);
        slot_b_[queued_] = pair.other_slot(k);
        queue_.set(queued_, pair.own(), i, pair.turned(), k, turn.b_to_a.point_error);
        if (++queued_ == simd::width) bound = hand_over(bound, turn.sane, flush);
      }
      if (is_first && queued_ != 0) bound = hand_over(bound, turn.sane, flush);
    }
    return bound;
  }

  /// Takes the direction of `way`, or keeps the last one if it has none.
  void set_towards(const Axis<float>& way) noexcept {
    const float length = std::sqrt(along(way, way));
    if (!(length > 1e-15F && length < 1e15F)) return;
    const float factor = (1.0F - 0x1p-16F) / length;
    towards_ = {way.x * factor, way.y * factor, way.z * factor};
  }

  float hand_over(float bound, bool sane, Flush flush) {
    Bounds16 bounds;
    queue_.bound(bounds);
    if (!sane) {
      bounds.lower.fill(0.0F);
      bounds.upper.fill(std::numeric_limits<float>::infinity());
    }
    for (std::size_t k = 0; k < queued_; ++k)
      if (bounds.upper[k] < least_upper_) {
        least_upper_ = bounds.upper[k];
        set_towards({bounds.x[k], bounds.y[k], bounds.z[k]});
        is_new_axis_ = true;
      }
    const std::size_t queued = queued_;
    queued_ = 0;
    return std::min(bound, flush(slot_a_, slot_b_, queued, bounds));
  }

  std::vector<Entry> stack_;
  TrianglePairs queue_;
  Slots slot_a_{}, slot_b_{};
  std::size_t queued_ = 0;
  // Direction of the shortest distance so far, from a to b, in the frame of a, of length <= 1. Along it, most triangles
  // of the two tree parts are at least as far apart. First the direction between the middles of the tree parts.
  Axis<float> towards_{};
  float least_upper_ = 0.0F;  // least upper bound so far, unit of a
  bool is_new_axis_ = false;
};

}  // namespace hinge::detail
