// SPDX-License-Identifier: BSD-3-Clause
// ClosestSearch: finds the closest pair of one or two models: tree parts by the gap of their boxes, then their trees.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/engine/simd/tree/find_closest.hpp"
#include "hinge/detail/engine/simd/tree/near_search.hpp"
#include "hinge/detail/engine/simd/tree/placed_trees.hpp"
#include "hinge/detail/engine/simd/tree/tree_operand.hpp"
#include "hinge/detail/engine/simd/tree/tree_parts.hpp"
#include "hinge/detail/engine/simd/tree/witnesses.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// Scratch memory of a search. PairTest is a TreePairTest.
template <Primitive P>
class ClosestSearch {
 public:
  ClosestSearch() { candidates_.reserve(most_candidates + simd::width); }
  void reserve(std::size_t depth) { finder_.reserve(depth); }
  void reserve_pairs(std::size_t most) { pairs_.reserve(most); }

  /// list(bound, pairs) fills `pairs` with all pairs of tree parts that may hold a pair with d - M <= bound.
  template <Collector C, class PairTest, class List>
  void run(const TreeOperand<P>& a, const TreeOperand<P>& b, NearSearch<P>& near, Witnesses<P>& witnesses,
           const PairTest& pair_test, C& collector, QueryCounts& counts, const List& list) {
    double bound = collector.cutoff();
    if constexpr (KeepsSmallest<C>) bound = std::min(bound, witnesses.bound(a.state, b.state, pair_test));
    pairs_.clear();
    list(bound, pairs_);
    const auto nearest_first = [](const PartPair& x, const PartPair& y) {
      return std::tie(x.gap, x.first, x.second) < std::tie(y.gap, y.first, y.second);
    };
    if constexpr (KeepsSmallestOfLinks<C>) {
      const auto links = [&](const PartPair& pair) {
        return std::pair(a.part(pair.first).link, b.part(pair.second).link);
      };
      std::sort(pairs_.begin(), pairs_.end(), [&](const PartPair& x, const PartPair& y) {
        const auto p = links(x), q = links(y);
        return p != q ? p < q : nearest_first(x, y);
      });
      for (std::size_t first = 0, last = 0; first < pairs_.size(); first = last) {
        const auto both = links(pairs_[first]);
        while (last < pairs_.size() && links(pairs_[last]) == both) ++last;
        search(a, b, near, pair_test, collector, counts, std::span(pairs_).subspan(first, last - first), bound,
               [&] { return collector.smallest(both.first, both.second); });
      }
    } else {
      std::sort(pairs_.begin(), pairs_.end(), nearest_first);
      search(a, b, near, pair_test, collector, counts, std::span(pairs_), bound, [&] { return collector.cutoff(); });
    }
    if constexpr (KeepsSmallest<C> && requires { collector.hit()->first; })
      if (collector.hit()) witnesses.remember(*collector.hit(), a.state, b.state);
  }

 private:
  struct Candidate {
    std::uint32_t slot_a, slot_b;
    double lower;  // lower bound of d - M, model unit
  };
  static constexpr std::size_t most_candidates = 1024;

  /// Searches pairs of tree parts that are sorted by their gaps. bound: upper bound of the d - M of interest.
  /// smallest(): the smallest d - M so far, or, if the collector does not keep it, its cutoff.
  template <Collector C, class PairTest, class Smallest>
  void search(const TreeOperand<P>& a, const TreeOperand<P>& b, NearSearch<P>& near, const PairTest& pair_test,
              C& collector, QueryCounts& counts, std::span<const PartPair> pairs, double bound,
              const Smallest& smallest) {
    constexpr bool keeps_smallest = KeepsSmallest<C> || KeepsSmallestOfLinks<C>;
    const auto cutoff = [&] { return std::min(collector.cutoff(), smallest()); };
    const double scale = a.trees.parts().scale;
    // Lower bound of d - M over all pairs.
    const double least = -std::max(a.trees.parts().largest_threshold, b.trees.parts().largest_threshold) -
                         a.largest_clearance() - b.largest_clearance();
    const auto is_settled = [&] { return keeps_smallest && smallest() <= least; };
    candidates_.clear();
    const auto settle = [&] {
      std::sort(candidates_.begin(), candidates_.end(),
                [](const Candidate& x, const Candidate& y) { return x.lower < y.lower; });
      for (const Candidate& c : candidates_) {
        if (c.lower > cutoff() || is_settled()) break;
        const PrimitiveId i = a.primitive(c.slot_a), j = b.primitive(c.slot_b);
        const P p = a.state.alone(i), q = b.state.alone(j);
        // If the pair of links has a hit within a margin, exact decisions are no longer needed.
        if (KeepsSmallestOfLinks<C> && collector.cutoff() > 0.0 && smallest() <= collector.cutoff())
          pair_test.test_pair.rounded(i, j, p, q, cutoff());
        else
          pair_test.test_pair(i, j, p, q);
      }
      candidates_.clear();
      bound = std::min(bound, cutoff());
    };
    if (keeps_smallest && least == 0.0) {
      // A yes/no search is faster. If it finds a collision, no pair can be closer.
      for (const PartPair& pair : pairs) {
        if (pair.gap > 0.0F || is_settled()) break;
        near.run(a, a.part(pair.first), b, b.part(pair.second), 0.0, pair_test, collector, counts);
      }
      bound = std::min(bound, cutoff());
    }
    for (const PartPair& pair : pairs) {
      if (collector.done() || is_settled()) break;
      const double extra = a.clearance_at(pair.first) + b.clearance_at(pair.second);
      // Overlapping boxes give no bound of the penetration depth.
      if (pair.gap > 0.0F && static_cast<double>(pair.gap) / scale - extra > bound) {
        if (extra == 0.0) break;  // nearest first
        continue;
      }
      const float* const reach_a = a.trees.parts().leaf_reach(0);
      const float* const reach_b = b.trees.parts().leaf_reach(0);
      const double ratio = scale / b.trees.parts().scale;
      finder_.run(a.trees.parts(), a.part(pair.first), b.trees.parts(), b.part(pair.second),
                  a.turn(a.part(pair.first), b, b.part(pair.second)).complete(), a.scaled(bound + extra), counts,
                  [&](const auto& slots_a, const auto& slots_b, std::size_t n, const Bounds16& bounds) {
                    for (std::size_t k = 0; k < n; ++k) {
                      double reach = 0.0;
                      if (reach_a != nullptr) reach += static_cast<double>(reach_a[slots_a[k]]);
                      if (reach_b != nullptr) reach += static_cast<double>(reach_b[slots_b[k]]) * ratio;
                      reach = reach / scale + extra;
                      const double upper = static_cast<double>(bounds.upper[k]) / scale;
                      if (keeps_smallest && upper - reach < bound) {
                        const PrimitiveId i = a.primitive(slots_a[k]), j = b.primitive(slots_b[k]);
                        if (pair_test.admits(i, j)) bound = std::min(bound, upper - pair_test.threshold(i, j));
                      }
                      const double lower = static_cast<double>(bounds.lower[k]) / scale - reach;
                      if (lower <= bound) candidates_.push_back({slots_a[k], slots_b[k], lower});
                    }
                    if (!keeps_smallest || candidates_.size() >= most_candidates) settle();
                    return a.scaled(bound + extra);
                  });
    }
    settle();
  }

  ClosestFinder<P> finder_;
  std::vector<PartPair> pairs_;
  std::vector<Candidate> candidates_;
};

}  // namespace hinge::detail
