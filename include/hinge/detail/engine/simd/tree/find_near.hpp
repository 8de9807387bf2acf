// SPDX-License-Identifier: BSD-3-Clause
// NearFinder: traverses two trees together and passes on the primitives that floats cannot prove apart.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/detail/core/function_ref.hpp"
#include "hinge/detail/engine/simd/tree/leaf_pair.hpp"
#include "hinge/detail/engine/simd/tree/relative_transform.hpp"
#include "hinge/detail/engine/simd/tree/tree_parts.hpp"
#include "hinge/detail/simd/gather_bits.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// Scratch memory of a traversal.
template <Primitive P>
class NearFinder {
 public:
  /// Reserves memory for trees with this sum of depths.
  void reserve(std::size_t depth) {
    const std::size_t room = (depth + 2) * per_round * simd::width + 2 * simd::width;
    if (room <= a_.size()) return;
    a_.resize(room);
    b_.resize(room);
  }

  /// Takes a slot, a leaf, the leaf's lanes, and whether the slot is in a and the leaf in b; returns false to stop.
  using Visit = FunctionRef<bool(std::uint32_t, std::uint32_t, simd::Bits, bool)>;

  /// Stops and returns false when visit returns false. `margin`: added to the reaches, unit of a. `turn` is completed
  /// on demand.
  bool run(const TreeParts<P>& a, const TreePart& part_a, const TreeParts<P>& b, const TreePart& part_b,
           RelativeTransform& turn, float margin, QueryCounts& counts, Visit visit) {
    const BoxProbe root(part_b.root_box, turn.b_to_a, margin);
    const bool a_is_leaf = is_leaf(part_a.top);
    const std::uint32_t top = a_is_leaf ? part_a.root / width : part_a.top;
    ++counts.boxes_tested;
    const simd::Bits first = near_lanes(a.store.nodes[top], root, turn.b_to_a);
    if (first == 0) return true;
    const Sides sides{{a, turn.b_to_a, margin, true}, {b, turn.a_to_b, margin / turn.b_to_a.ratio, false}, turn.sane};
    std::size_t left = 0;
    std::uint64_t tested = 0;
    bool going = true;
    if (!is_leaf(part_b.top)) {
      left = push_a(first, top, part_b.root, 0);
    } else if (a_is_leaf) {
      turn.complete();
      const TransformedLeaf<P> turned(b, part_b.root, turn.b_to_a);
      going = run_leaves(sides, sides.a, part_a.root, sides.b, part_b.root, turned, counts, visit);
    } else {
      turn.complete();
      going = open_by_leaf(sides, sides.a, part_a.root, sides.b, part_b.root, counts, visit,
                           [&](simd::Bits lanes) { left = push_a(lanes, top, part_b.root, left); });
    }
    while (going && left != 0) {
      // Several pairs at a time, so that their tests overlap in the processor.
      std::array<BoxId, per_round> xs, ys;
      const std::size_t taken = std::min(left, per_round);
      left -= taken;
      std::copy_n(a_.data() + left, taken, xs.data());
      std::copy_n(b_.data() + left, taken, ys.data());
      tested += taken;
      for (std::size_t k = 0; going && k < taken; ++k) {
        const BoxId x = xs[k], y = ys[k];
        const std::uint32_t in_x = a.store.child(x), in_y = b.store.child(y);
        if (!is_leaf(in_x) && !is_leaf(in_y) && a.store.size(x) >= b.store.size(y) * turn.b_to_a.ratio) {
          const simd::Bits near = y == part_b.root ? near_lanes(a.store.nodes[in_x], root, turn.b_to_a)
                                                   : open(sides.a, in_x, b.store.box(y));
          left = push_a(near, in_x, y, left);
          continue;
        }
        turn.complete();
        if (is_leaf(in_x)) {
          going = open_by_leaf(sides, sides.b, y, sides.a, x, counts, visit,
                               [&](simd::Bits lanes) { left = push_b(lanes, in_y, x, left); });
        } else if (is_leaf(in_y)) {
          going = open_by_leaf(sides, sides.a, x, sides.b, y, counts, visit,
                               [&](simd::Bits lanes) { left = push_a(lanes, in_x, y, left); });
        } else {
          left = push_b(open(sides.b, in_y, a.store.box(x)), in_y, x, left);
        }
      }
    }
    counts.boxes_tested += tested;
    return going;
  }

 private:
  static constexpr std::size_t per_round = 12;
  static constexpr auto width = static_cast<std::uint32_t>(simd::width);
  /// Up to this many lanes are tested without checking whether the other leaf has fewer.
  static constexpr int few = 1;

  /// One of the two trees, the transform from the other tree to it, and the margin in its unit.
  struct Side {
    const TreeParts<P>& tree;
    const Turn& turn;
    float margin;
    bool is_a;
  };
  struct Sides {
    Side a, b;
    bool sane;
  };

  static bool is_leaf(std::uint32_t child) noexcept { return (child & TreeNode::leaf_bit) != 0; }

  /// Lanes of a node that are near a box of the other tree.
  [[gnu::always_inline]] static simd::Bits open(const Side& side, std::uint32_t node, const TreeBox& box) noexcept {
    return near_lanes(side.tree.store.nodes[node], BoxProbe(box, side.turn, side.margin), side.turn);
  }
  [[gnu::always_inline]] std::size_t push_a(simd::Bits lanes, std::uint32_t node, BoxId y, std::size_t left) noexcept {
    std::fill_n(b_.data() + left, simd::width, y);
    return left + simd::append_lanes(lanes, node * width, a_.data() + left);
  }
  [[gnu::always_inline]] std::size_t push_b(simd::Bits lanes, std::uint32_t node, BoxId x, std::size_t left) noexcept {
    std::fill_n(a_.data() + left, simd::width, x);
    return left + simd::append_lanes(lanes, node * width, b_.data() + left);
  }

  /// Tests box x of a node against box y of a leaf of the other tree. The leaf is transformed once and tested against
  /// x. The children of x are tested only if a primitive of the leaf is near. push(lanes that hold nodes).
  template <class Push>
  [[gnu::always_inline]] static bool open_by_leaf(const Sides& sides, const Side& own, BoxId x, const Side& other,
                                                  BoxId y, QueryCounts& counts, Visit visit, const Push& push) {
    const TransformedLeaf<P> turned(other.tree, y, own.turn);
    if (turned.near_box(own.tree.store.box(x), own.margin) == 0) return true;
    const std::uint32_t in_x = own.tree.store.child(x);
    const TreeNode& node = own.tree.store.nodes[in_x];
    const simd::Bits near = open(own, in_x, other.tree.store.box(y));
    push(near & node.inner);
    for (simd::Bits lanes = near & ~node.inner; lanes != 0; lanes &= lanes - 1) {
      const BoxId lane = in_x * width + static_cast<BoxId>(std::countr_zero(lanes));
      if (!run_leaves(sides, own, lane, other, y, turned, counts, visit)) return false;
    }
    return true;
  }

  /// `turned`: the leaf below y, transformed into the frame of `own`.
  [[gnu::always_inline]] static bool run_leaves(const Sides& sides, const Side& own, BoxId x, const Side& other,
                                                BoxId y, const TransformedLeaf<P>& turned, QueryCounts& counts,
                                                Visit visit) {
    const LeafPair<P> pair(own.tree, x, turned, own.margin);
    if (pair.ones() == 0) return true;
    if (std::popcount(pair.ones()) > few) {
      // If the leaf's primitives are small and this leaf is large, fewer primitives of this leaf may be near the other.
      const TransformedLeaf<P> other_way(own.tree, x, other.turn);
      const LeafPair<P> reverse(other.tree, y, other_way, other.margin);
      if (std::popcount(reverse.ones()) < std::popcount(pair.ones()))
        return run_pair(reverse, sides.sane, counts, visit, own.is_a);
    }
    return run_pair(pair, sides.sane, counts, visit, other.is_a);
  }

  [[gnu::always_inline]] static bool run_pair(const LeafPair<P>& pair, bool sane, QueryCounts& counts, Visit visit,
                                              bool slot_in_a) {
    for (simd::Bits ones = pair.ones(); ones != 0; ones &= ones - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(ones));
      ++counts.pairs_tested;
      const simd::Bits lanes = sane ? pair.turned().near(k, pair.own(), pair.real(), pair.nearness()) : pair.real();
      if (lanes != 0 && !visit(pair.other_slot(k), pair.leaf(), lanes, slot_in_a)) return false;
    }
    return true;
  }

  std::vector<BoxId> a_, b_;  // pairs of boxes to be opened
};

}  // namespace hinge::detail
