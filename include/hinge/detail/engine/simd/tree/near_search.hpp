// SPDX-License-Identifier: BSD-3-Clause
// NearSearch: traverses the trees of two tree parts, and decides the remaining pairs in double.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "hinge/core/id.hpp"
#include "hinge/detail/engine/simd/tree/find_near.hpp"
#include "hinge/detail/engine/simd/tree/tree_operand.hpp"
#include "hinge/detail/engine/simd/tree/tree_parts.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// Scratch memory of a traversal. PairTest is a TreePairTest.
template <Primitive P>
class NearSearch {
 public:
  void reserve(std::size_t depth) { finder_.reserve(depth); }

  /// Tests all pairs of two tree parts with d - M <= cutoff (plus clearances), until the collector is done.
  template <Collector C, class PairTest>
  void run(const TreeOperand<P>& a, const TreePart& part_a, const TreeOperand<P>& b, const TreePart& part_b,
           double cutoff, const PairTest& pair_test, C& collector, QueryCounts& counts) {
    if (!asks(collector, part_a.link, part_b.link)) return;
    const double margin = cutoff + a.clearance_at(part_a) + b.clearance_at(part_b);
    // The tree with the larger root is opened first, against the root of the other tree.
    const bool turned =
        part_a.root_size * static_cast<float>(b.trees.parts().scale / a.trees.parts().scale) < part_b.root_size;
    const TreeOperand<P>&x = turned ? b : a, &y = turned ? a : b;
    const TreePart &part_x = turned ? part_b : part_a, &part_y = turned ? part_a : part_b;
    RelativeTransform turn = x.turn(part_x, y, part_y);
    finder_.run(x.trees.parts(), part_x, y.trees.parts(), part_y, turn, x.scaled(margin), counts,
                [&](std::uint32_t slot, std::uint32_t leaf, simd::Bits lanes, bool slot_in_x) {
                  const TreeOperand<P>&of_slot = slot_in_x ? x : y, &of_leaf = slot_in_x ? y : x;
                  const PrimitiveId one = of_slot.primitive(slot);
                  const P alone = of_slot.state.alone(one);
                  for (; lanes != 0; lanes &= lanes - 1) {
                    const auto k = static_cast<std::uint32_t>(std::countr_zero(lanes));
                    const PrimitiveId i = of_leaf.primitive(leaf * static_cast<std::uint32_t>(simd::width) + k);
                    const P other = of_leaf.state.alone(i);
                    slot_in_x != turned ? pair_test.test_pair(one, i, alone, other)
                                        : pair_test.test_pair(i, one, other, alone);
                    if (collector.done() || !asks(collector, part_a.link, part_b.link)) return false;
                  }
                  return true;
                });
  }

 private:
  /// True if the collector still wants pairs of these links. Merged tree parts have no single link: do not use them
  /// with collectors that refuse links.
  template <Collector C>
  static bool asks(const C& collector, LinkId a, LinkId b) noexcept {
    if constexpr (RefusesLinks<C>) return collector.wants(a, b);
    return true;
  }

  NearFinder<P> finder_;
};

}  // namespace hinge::detail
