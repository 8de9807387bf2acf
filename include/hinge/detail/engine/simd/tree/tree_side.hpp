// SPDX-License-Identifier: BSD-3-Clause
// TreeSide: the tree half of engine/simd for one model, and its queries.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/engine/simd/tree/closest_search.hpp"
#include "hinge/detail/engine/simd/tree/cross_operands.hpp"
#include "hinge/detail/engine/simd/tree/learned_order.hpp"
#include "hinge/detail/engine/simd/tree/near_search.hpp"
#include "hinge/detail/engine/simd/tree/pair_numbers.hpp"
#include "hinge/detail/engine/simd/tree/placed_trees.hpp"
#include "hinge/detail/engine/simd/tree/tree_operand.hpp"
#include "hinge/detail/engine/simd/tree/tree_parts.hpp"
#include "hinge/detail/engine/simd/tree/witnesses.hpp"
#include "hinge/model/state.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// One model and its scratch memory. Each count stands for sixteen lanes. PairTest is a TreePairTest.
template <Primitive P>
class TreeSide {
 public:
  explicit TreeSide(std::shared_ptr<const TreeParts<P>> parts)
      : trees_(std::move(parts)), cross_order_(trees_.parts().links.size()), asked_(trees_.parts().links.size()) {
    near_.reserve(2 * trees_.parts().depth);
    closest_.reserve(2 * trees_.parts().depth);
    // Reserve memory so that queries of usual models never allocate.
    const std::size_t n = trees_.parts().links.size();
    closest_.reserve_pairs(std::min<std::size_t>(n * n / 2, 1U << 16U));
  }

  template <Collector C, class PairTest>
  void self_query(State<P>& state, const PairTest& pair_test, C& collector, const QueryOptions& options,
                  QueryCounts& counts) {
    trees_.refresh(state);
    const TreeOperand<P> mine{trees_, state, options.clearance};
    const auto wanted = [&](const TreePart& a, const TreePart& b) {
      const auto g = id<GroupId>(a.group), h = id<GroupId>(b.group);
      return options.groups.holds_larger(g, h) && (!options.moved_only || state.moved_apart(g, h));
    };
    const double most = mine.largest_clearance();
    if constexpr (C::ranks || KeepsSmallestOfLinks<C>) {
      const PlacedParts& placed = trees_.links();
      const std::size_t n = placed.set().size();
      closest_.run(
          mine, mine, near_, witnesses_, pair_test, collector, counts, [&](double bound, std::vector<PartPair>& pairs) {
            for (std::size_t p = 1; p < n; ++p)
              placed.append_before(p, mine.scaled(bound + mine.clearance_at(p) + most), pairs);
            counts.boxes_tested += n * placed.row_count() / 2;
            std::erase_if(pairs,
                          [&](const PartPair& pair) { return !wanted(mine.part(pair.first), mine.part(pair.second)); });
          });
    } else {
      PlacedParts& placed = RefusesLinks<C> ? trees_.links() : trees_.merged();
      const std::vector<TreePart>& parts = placed.set().parts;
      const auto look = [&](std::size_t q, std::size_t p) {
        near_.run(mine, parts[q], mine, parts[p], collector.cutoff(), pair_test, collector, counts);
        return !collector.done();
      };
      counts.boxes_tested += parts.size() * placed.row_count() / 2;
      const auto margin = [&](std::size_t p) {
        return mine.scaled(collector.cutoff() + mine.clearance_at(parts[p]) + most);
      };
      if (RefusesLinks<C> || !StopsAtFirst<C> || !order_.is_learned())
        return placed.sweep(
            margin, [&](std::uint32_t q, std::uint32_t p) { return !wanted(parts[q], parts[p]) || look(q, p); });
      order_.start();
      placed.sweep(margin, [&](std::uint32_t q, std::uint32_t p) {
        if (wanted(parts[q], parts[p])) order_.mark(numbers_.of(q, p));
        return true;
      });
      order_.each([&](std::size_t pair) { return look(numbers_.parts(pair)[0], numbers_.parts(pair)[1]); });
    }
  }

  /// Adds the present state to the learned order of yes/no queries. `any` is the collector of pair_test.
  template <Collector C, class PairTest>
  void learn(State<P>& state, const PairTest& pair_test, C& any) {
    const PartSet& set = trees_.parts().merged();
    if (set.size() > most_ordered) return;
    if (!order_.is_learned()) {
      numbers_ = PairNumbers(set.tested, set.size());
      order_ = LearnedOrder(numbers_.size());
    }
    trees_.refresh(state);
    const TreeOperand<P> mine{trees_, state, {}};
    trees_.merged().sweep([](std::size_t) { return 0.0F; },
                          [&](std::uint32_t q, std::uint32_t p) {
                            any = C{};
                            QueryCounts counts;
                            near_.run(mine, set.parts[q], mine, set.parts[p], 0.0, pair_test, any, counts);
                            order_.add(numbers_.of(q, p), any.done(), counts.boxes_tested + counts.pairs_tested);
                            return true;
                          });
  }
  /// The same for queries against other models: the order of this model's tree parts.
  template <Collector C, class PairTest>
  void learn(State<P>& state, TreeSide& theirs, State<P>& their_state, const PairTest& pair_test, C& any) {
    const CrossOperands<P> cross(trees_, state, theirs.trees_, their_state, {});
    near_.reserve(trees_.parts().depth + theirs.trees_.parts().depth);
    for (std::size_t q = 0; q < theirs.trees_.parts().links.size(); ++q)
      each_meeting<C>(cross, pair_test, q, 0.0F, [&](std::size_t p, const TreePart& part) {
        any = C{};
        QueryCounts counts;
        near_.run(cross.mine, part, cross.others, cross.others.part(q), 0.0, pair_test, any, counts);
        cross_order_.add(p, any.done(), counts.boxes_tested + counts.pairs_tested);
        return true;
      });
  }

  /// True if the units of both models are similar enough for floats.
  bool fits(const TreeSide& theirs) const noexcept {
    const double ratio = trees_.parts().scale / theirs.trees_.parts().scale;
    return ratio >= 0x1p-60 && ratio <= 0x1p60;
  }

  /// A query between two models.
  template <Collector C, class PairTest>
  void query(State<P>& state, TreeSide& theirs, State<P>& their_state, const PairTest& pair_test, C& collector,
             const QueryOptions& options, QueryCounts& counts) {
    const CrossOperands<P> cross(trees_, state, theirs.trees_, their_state, options);
    const TreeOperand<P>&mine = cross.mine, &others = cross.others;
    const std::size_t depth = trees_.parts().depth + theirs.trees_.parts().depth;
    near_.reserve(depth);
    closest_.reserve(depth);
    const std::size_t n = theirs.trees_.parts().links.size();
    const double most = mine.largest_clearance();
    if constexpr (C::ranks || KeepsSmallestOfLinks<C>) {
      if (witnessed_.lock() != theirs.trees_.shared_parts()) cross_witnesses_.clear();
      witnessed_ = theirs.trees_.shared_parts();
      closest_.run(mine, others, near_, cross_witnesses_, pair_test, collector, counts,
                   [&](double bound, std::vector<PartPair>& pairs) {
                     for (std::size_t q = 0; q < n; ++q)
                       trees_.links().append_near(cross.their_box(q),
                                                  mine.scaled(bound + others.clearance_at(q) + most), q, pairs);
                     counts.boxes_tested += n * trees_.links().row_count();
                     std::erase_if(pairs, [&](const PartPair& pair) {
                       return !cross.wanted(pair_test, pair.first, pair.second);
                     });
                   });
    } else {
      const bool in_order = StopsAtFirst<C> && cross_order_.is_learned();
      for (std::size_t q = 0; q < n && !collector.done(); ++q) {
        counts.boxes_tested += trees_.links().row_count();
        const float margin = mine.scaled(collector.cutoff() + others.clearance_at(q) + most);
        const auto look = [&](const TreePart& part) {
          near_.run(mine, part, others, others.part(q), collector.cutoff(), pair_test, collector, counts);
          return !collector.done();
        };
        if (!in_order) {
          each_meeting<C>(cross, pair_test, q, margin, [&](std::size_t, const TreePart& part) { return look(part); });
          continue;
        }
        cross_order_.start();
        each_meeting<C>(cross, pair_test, q, margin, [&](std::size_t p, const TreePart& part) {
          cross_order_.mark(p);
          asked_[p] = &part;
          return true;
        });
        cross_order_.each([&](std::size_t p) { return look(*asked_[p]); });
      }
    }
  }

 private:
  /// Calls visit(p, part) -> bool for the tree parts whose boxes come within `margin` of tree part q of the other
  /// model. If several of one group are near, all its links are wanted, and the collector need not distinguish links,
  /// the whole group is visited once, with p the first of them.
  template <Collector C, class PairTest, class Visit>
  void each_meeting(const CrossOperands<P>& cross, const PairTest& pair_test, std::size_t q, float margin,
                    const Visit& visit) {
    const std::vector<TreePart>& parts = trees_.parts().links.parts;
    const auto met = trees_.links().meeting(cross.their_box(q).grown(margin));
    const auto wanted = [&](std::size_t p) { return cross.wanted(pair_test, p, q); };
    for (std::size_t k = 0; k < met.size();) {
      const std::size_t p = met[k++];
      const std::uint32_t group = parts[p].group;
      const TreePart& whole = trees_.parts().whole[group];
      if (!RefusesLinks<C> && whole.root_size > 0.0F && k < met.size() && parts[met[k]].group == group) {
        std::size_t first = p, last = p + 1;
        while (first > 0 && parts[first - 1].group == group) --first;
        while (last < parts.size() && parts[last].group == group) ++last;
        bool all = true;
        for (std::size_t other = first; other < last; ++other) all = all && wanted(other);
        if (all) {
          while (k < met.size() && parts[met[k]].group == group) ++k;
          if (!visit(p, whole)) return;
          continue;
        }
      }
      if (wanted(p) && !visit(p, parts[p])) return;
    }
  }

  /// Maximum number of tree parts: the order of pairs needs the square of it in memory.
  static constexpr std::size_t most_ordered = 1024;

  PlacedTrees<P> trees_;
  NearSearch<P> near_;
  ClosestSearch<P> closest_;
  PairNumbers numbers_;                 // set when an order is learned
  LearnedOrder order_{0};               // of tested pairs
  LearnedOrder cross_order_;            // of tree parts
  std::vector<const TreePart*> asked_;  // scratch: for a tree part, the part itself or its whole group
  Witnesses<P> witnesses_, cross_witnesses_;
  std::weak_ptr<const TreeParts<P>> witnessed_;  // the model whose pairs cross_witnesses_ holds
};

/// Avoids compiling the tree code for primitives that are never kept in trees.
template <Primitive P>
using OptionalTreeSide = std::optional<std::conditional_t<UsesStaticBvh<P>, TreeSide<P>, std::monostate>>;

}  // namespace hinge::detail
