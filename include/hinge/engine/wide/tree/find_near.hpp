// SPDX-License-Identifier: BSD-3-Clause
// NearFinder: walks two trees side by side and hands over what floats cannot prove to be apart.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/engine/wide/tree/leaf_pair.hpp"
#include "hinge/engine/wide/tree/relative_turn.hpp"
#include "hinge/engine/wide/tree/tree_parts.hpp"
#include "hinge/query/query_options.hpp"
#include "hinge/simd/gather_bits.hpp"

namespace hinge {

/// Scratch of such walks.
template <Primitive P>
class NearFinder {
 public:
  /// Room for walks through trees of these depths together.
  void reserve(std::size_t depth) {
    const std::size_t room = (depth + 2) * per_round * simd::width + 2 * simd::width;
    if (room <= a_.size()) return;
    a_.resize(room);
    b_.resize(room);
    leaf_a_.resize((per_round + 2) * simd::width);
    leaf_b_.resize((per_round + 2) * simd::width);
  }

  /// visit(slot, leaf, lanes of that leaf, is the slot in a and the leaf in b?) -> go on? `margin`: what counts as near
  /// beyond reaches, unit of a. Returns false when stopped.
  template <class Visit>
  bool run(const TreeParts<P>& a, const TreePart& part_a, const TreeParts<P>& b, const TreePart& part_b,
           const RelativeTurn& turn, float margin, QueryCounts& counts, const Visit& visit) {
    const float other_margin = margin / turn.b_to_a.ratio;
    const auto open_a = [&](BoxId x, BoxId y) __attribute__((always_inline)) {
      const TreeBox box = b.store.box(y);
      return near_lanes(a.store.nodes[x], box, turn.b_to_a(box), turn.b_to_a, margin);
    };
    const auto open_b = [&](BoxId x, BoxId y) __attribute__((always_inline)) {
      const TreeBox box = a.store.box(x);
      return near_lanes(b.store.nodes[y], box, turn.a_to_b(box), turn.a_to_b, other_margin);
    };
    constexpr auto width = static_cast<std::uint32_t>(simd::width);
    if ((open_a(part_a.root / width, part_b.root) & 1U) == 0) {
      ++counts.boxes_tested;
      return true;
    }
    std::size_t left = 0, leaves = 0, tested = 1;
    if (a.store.is_leaf(part_a.root) && b.store.is_leaf(part_b.root)) {
      leaf_a_[leaves] = part_a.root;
      leaf_b_[leaves++] = part_b.root;
    } else {
      a_[left] = part_a.root;
      b_[left++] = part_b.root;
    }
    bool going = true;
    while (going && (left != 0 || leaves != 0)) {
      // Several at a time, so that their tests overlap in the processor.
      std::array<BoxId, per_round> xs, ys;
      const std::size_t taken = std::min(left, per_round);
      left -= taken;
      std::copy_n(a_.data() + left, taken, xs.data());
      std::copy_n(b_.data() + left, taken, ys.data());
      tested += taken;
      for (std::size_t k = 0; k < taken; ++k) {
        const BoxId x = xs[k], y = ys[k];
        const bool x_leaf = a.store.is_leaf(x), y_leaf = b.store.is_leaf(y);
        if (y_leaf || (!x_leaf && a.store.size(x) >= b.store.size(y) * turn.b_to_a.ratio)) {
          const std::uint32_t node = a.store.child(x);
          const simd::Bits near = open_a(node, y), inner = y_leaf ? a.store.nodes[node].inner : simd::all_bits;
          simd::append_lanes(near & inner, node * width, a_.data() + left);
          left += fill(near & inner, y, b_.data() + left);
          simd::append_lanes(near & ~inner, node * width, leaf_a_.data() + leaves);
          leaves += fill(near & ~inner, y, leaf_b_.data() + leaves);
        } else {
          const std::uint32_t node = b.store.child(y);
          const simd::Bits near = open_b(x, node), inner = x_leaf ? b.store.nodes[node].inner : simd::all_bits;
          simd::append_lanes(near & inner, node * width, b_.data() + left);
          left += fill(near & inner, x, a_.data() + left);
          simd::append_lanes(near & ~inner, node * width, leaf_b_.data() + leaves);
          leaves += fill(near & ~inner, x, leaf_a_.data() + leaves);
        }
      }
      for (std::size_t k = 0; going && k < leaves; ++k)
        going = run_leaves(a, leaf_a_[k], b, leaf_b_[k], turn, margin, other_margin, counts, visit);
      leaves = 0;
    }
    counts.boxes_tested += tested;
    return going;
  }

 private:
  static constexpr std::size_t per_round = 12;
  /// Up to as many are looked at one by one without asking whether the other way round there are fewer.
  static constexpr int few = 1;

  /// One value for every set bit; writes `width` of them, whatever the mask.
  [[gnu::always_inline]] static std::size_t fill(simd::Bits mask, std::uint32_t value, std::uint32_t* to) noexcept {
    std::fill_n(to, simd::width, value);
    return static_cast<std::size_t>(std::popcount(mask));
  }

  template <class Visit>
  [[gnu::always_inline]] static bool run_leaves(const TreeParts<P>& a, BoxId x, const TreeParts<P>& b, BoxId y,
                                                const RelativeTurn& turn, float margin, float other_margin,
                                                QueryCounts& counts, const Visit& visit) {
    const LeafPair<P> pair(a, x, b, y, turn.b_to_a, margin);
    const auto to_b = [&](auto slot, auto leaf, auto lanes) { return visit(slot, leaf, lanes, false); };
    if (std::popcount(pair.ones()) <= few) return run_pair(pair, turn.sane, counts, to_b);
    // Small primitives of b in a large leaf of a: those of a that touch their leaf may be fewer.
    const LeafPair<P> turned(b, y, a, x, turn.a_to_b, other_margin);
    if (std::popcount(turned.ones()) >= std::popcount(pair.ones())) return run_pair(pair, turn.sane, counts, to_b);
    return run_pair(turned, turn.sane, counts,
                    [&](auto slot, auto leaf, auto lanes) { return visit(slot, leaf, lanes, true); });
  }

  template <class Visit>
  [[gnu::always_inline]] static bool run_pair(const LeafPair<P>& pair, bool sane, QueryCounts& counts,
                                              const Visit& visit) {
    for (simd::Bits ones = pair.ones(); ones != 0; ones &= ones - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(ones));
      ++counts.pairs_tested;
      const simd::Bits lanes = sane ? pair.turned().near(k, pair.own(), pair.real(), pair.nearness()) : pair.real();
      if (lanes != 0 && !visit(pair.other_slot(k), pair.leaf(), lanes)) return false;
    }
    return true;
  }

  std::vector<BoxId> a_, b_;            // pairs of boxes, one of which is to be opened
  std::vector<BoxId> leaf_a_, leaf_b_;  // pairs of boxes that hold leaves
};

}  // namespace hinge
