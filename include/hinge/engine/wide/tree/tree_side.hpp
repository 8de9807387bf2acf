// SPDX-License-Identifier: BSD-3-Clause
// TreeSide: one model in the tree half of engine/wide, and the queries that walk its trees.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/engine/wide/tree/find_closest.hpp"
#include "hinge/engine/wide/tree/find_near.hpp"
#include "hinge/engine/wide/tree/pair_order.hpp"
#include "hinge/engine/wide/tree/relative_turn.hpp"
#include "hinge/engine/wide/tree/tree_operand.hpp"
#include "hinge/engine/wide/tree/tree_parts.hpp"
#include "hinge/engine/wide/tree/tree_state.hpp"
#include "hinge/engine/wide/tree/witnesses.hpp"
#include "hinge/model/placement.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/primitive/leaf.hpp"
#include "hinge/query/pair_rules.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge {

/// One model and its scratch. Counts are of sixteen lanes each. A query's Judge is a TreeJudge.
template <Primitive P>
class TreeSide {
 public:
  explicit TreeSide(std::shared_ptr<const TreeParts<P>> parts)
      : state_(std::move(parts)), order_(state_.parts().parts.size()) {
    finder_.reserve(2 * state_.parts().depth);
    closest_.reserve(2 * state_.parts().depth);
    // So that queries of usual models never allocate.
    const std::size_t n = state_.parts().parts.size();
    pairs_.reserve(std::min<std::size_t>(n * n / 2, 1U << 16U));
    candidates_.reserve(most_candidates + simd::width);
  }

  template <Collector C, class Judge>
  void self_query(Placement<P>& placement, const Judge& judge, C& collector, const QueryOptions& options,
                  QueryCounts& counts) {
    state_.refresh(placement);
    const TreeOperand<P> mine{state_, placement, options.clearance};
    const auto wanted = [&](std::uint32_t q, std::size_t p) {
      const TreePart &a = mine.part(q), &b = mine.part(p);
      return !options.moved_only || placement.moved_apart(id<GroupId>(a.group), id<GroupId>(b.group));
    };
    const std::size_t n = state_.parts().parts.size();
    const double most = mine.largest_clearance();
    if constexpr (C::ranks) {
      find_closest(mine, mine, witnesses_, judge, collector, counts, [&](double bound) {
        for (std::size_t p = 1; p < n; ++p)
          state_.append_before(p, mine.scaled(bound + mine.clearance_at(p) + most), pairs_);
        counts.boxes_tested += n * state_.parts().rows() / 2;
        std::erase_if(pairs_, [&](const PartPair& pair) { return !wanted(pair.first, pair.second); });
      });
    } else if (StopsAtFirst<C> && order_.is_learned()) {
      pairs_.clear();
      each_candidate(mine, most, wanted, counts, [&](std::uint32_t q, std::uint32_t p) {
        pairs_.push_back({order_.weight(p, q), q, p});
      });
      std::sort(pairs_.begin(), pairs_.end(), [](const PartPair& x, const PartPair& y) { return x.gap > y.gap; });
      for (const PartPair& pair : pairs_) {
        find_near(mine, pair.first, mine, pair.second, 0.0, judge, collector, counts);
        if (collector.done()) break;
      }
    } else {
      for (std::size_t p = 1; p < n && !collector.done(); ++p) {
        counts.boxes_tested += p / simd::width + 1;
        for (const std::uint32_t q : state_.before(p, mine.scaled(collector.cutoff() + mine.clearance_at(p) + most))) {
          if (!wanted(q, p)) continue;
          find_near(mine, q, mine, p, collector.cutoff(), judge, collector, counts);
          if (collector.done()) break;
        }
      }
    }
  }

  /// Adds the present state to what the order of yes/no queries is learned from; `any` is the judge's collector.
  template <Collector C, class Judge>
  void learn(Placement<P>& placement, const Judge& judge, C& any) {
    if (state_.parts().parts.size() > most_ordered) return;
    state_.refresh(placement);
    const TreeOperand<P> mine{state_, placement, {}};
    pairs_.clear();
    QueryCounts counts;
    each_candidate(
        mine, 0.0, [](std::size_t, std::size_t) { return true; }, counts,
        [&](std::uint32_t q, std::uint32_t p) {
          pairs_.push_back({0.0F, q, p});
        });
    for (const PartPair& pair : pairs_) {
      any = C{};
      counts = {};
      find_near(mine, pair.first, mine, pair.second, 0.0, judge, any, counts);
      order_.add(pair.first, pair.second, any.done(), counts.boxes_tested + counts.pairs_tested);
    }
    order_.settle();
  }

  /// Are the units of the two alike enough for floats to hold both?
  bool fits(const TreeSide& theirs) const noexcept {
    const double ratio = state_.parts().scale / theirs.state_.parts().scale;
    return ratio >= 0x1p-60 && ratio <= 0x1p60;
  }

  /// Between two models.
  template <Collector C, class Judge>
  void query(Placement<P>& placement, TreeSide& theirs, Placement<P>& their_placement, const Judge& judge, C& collector,
             const QueryOptions& options, QueryCounts& counts) {
    state_.refresh(placement);
    theirs.state_.refresh(their_placement);
    const TreeOperand<P> mine{state_, placement, options.clearance};
    const TreeOperand<P> others{theirs.state_, their_placement, options.other_clearance};
    const std::size_t depth = state_.parts().depth + theirs.state_.parts().depth;
    finder_.reserve(depth);
    closest_.reserve(depth);
    const auto wanted = [&](std::size_t p, std::size_t q) {
      const TreePart &a = mine.part(p), &b = others.part(q);
      return judge.admits_links(a.link, b.link) && (!options.moved_only || placement.moved(id<GroupId>(a.group)) ||
                                                    their_placement.moved(id<GroupId>(b.group)));
    };
    // Their boxes in this model's unit and origin.
    const auto ratio = static_cast<float>(state_.parts().scale / theirs.state_.parts().scale);
    const auto their_box = [&](std::size_t q) {
      FloatBox box = theirs.state_.world_box(q, their_placement, state_.world_origin());
      for (std::size_t k = 0; k < 3; ++k) {
        box.lower[k] *= ratio;
        box.upper[k] *= ratio;
      }
      return box;
    };
    const std::size_t n = theirs.state_.parts().parts.size();
    const double most = mine.largest_clearance();
    if constexpr (C::ranks) {
      if (witnessed_.lock() != theirs.state_.shared_parts()) cross_witnesses_.clear();
      witnessed_ = theirs.state_.shared_parts();
      find_closest(mine, others, cross_witnesses_, judge, collector, counts, [&](double bound) {
        for (std::size_t q = 0; q < n; ++q)
          state_.append_near(their_box(q), mine.scaled(bound + others.clearance_at(q) + most), q, pairs_);
        counts.boxes_tested += n * state_.parts().rows();
        std::erase_if(pairs_, [&](const PartPair& pair) { return !wanted(pair.first, pair.second); });
      });
    } else {
      for (std::size_t q = 0; q < n && !collector.done(); ++q) {
        counts.boxes_tested += state_.parts().rows();
        const float margin = mine.scaled(collector.cutoff() + others.clearance_at(q) + most);
        for (const std::uint32_t p : state_.meeting(their_box(q).grown(margin))) {
          if (!wanted(p, q)) continue;
          find_near(mine, p, others, q, collector.cutoff(), judge, collector, counts);
          if (collector.done()) break;
        }
      }
    }
  }

 private:
  template <Collector C>
  static bool asks(const C& collector, LinkId a, LinkId b) noexcept {
    if constexpr (RefusesLinks<C>) return collector.wants(a, b);
    return true;
  }

  template <class Wanted, class Visit>
  void each_candidate(const TreeOperand<P>& mine, double most, const Wanted& wanted, QueryCounts& counts,
                      const Visit& visit) {
    for (std::size_t p = 1; p < state_.parts().parts.size(); ++p) {
      counts.boxes_tested += p / simd::width + 1;
      for (const std::uint32_t q : state_.before(p, mine.scaled(mine.clearance_at(p) + most)))
        if (wanted(q, p)) visit(q, static_cast<std::uint32_t>(p));
    }
  }

  /// All pairs of two parts with d - M below a margin, until the collector wants no more.
  template <Collector C, class Judge>
  void find_near(const TreeOperand<P>& a, std::size_t p, const TreeOperand<P>& b, std::size_t q, double cutoff,
                 const Judge& judge, C& collector, QueryCounts& counts) {
    const TreePart &part_a = a.part(p), &part_b = b.part(q);
    if (!asks(collector, part_a.link, part_b.link)) return;
    const double margin = cutoff + a.clearance_at(p) + b.clearance_at(q);
    finder_.run(a.state.parts(), part_a, b.state.parts(), part_b, a.turn(p, b, q), a.scaled(margin), counts,
                [&](std::uint32_t slot, std::uint32_t leaf, simd::Bits lanes, bool slot_in_a) {
                  const TreeOperand<P>&of_slot = slot_in_a ? a : b, &of_leaf = slot_in_a ? b : a;
                  const PrimitiveId one = of_slot.primitive(slot);
                  const P alone = of_slot.placement.alone(one);
                  for (; lanes != 0; lanes &= lanes - 1) {
                    const auto k = static_cast<std::uint32_t>(std::countr_zero(lanes));
                    const PrimitiveId i = of_leaf.primitive(leaf * static_cast<std::uint32_t>(simd::width) + k);
                    const P other = of_leaf.placement.alone(i);
                    slot_in_a ? judge.decide(one, i, alone, other) : judge.decide(i, one, other, alone);
                    if (collector.done() || !asks(collector, part_a.link, part_b.link)) return false;
                  }
                  return true;
                });
  }

  /// list(bound) fills pairs_ with all parts that may hold a pair with d - M <= bound.
  template <Collector C, class Judge, class List>
  void find_closest(const TreeOperand<P>& a, const TreeOperand<P>& b, Witnesses<P>& witnesses, const Judge& judge,
                    C& collector, QueryCounts& counts, const List& list) {
    const double scale = a.state.parts().scale;
    double bound = collector.cutoff();
    if constexpr (KeepsSmallest<C>) bound = std::min(bound, witnesses.bound(a.placement, b.placement, judge));
    pairs_.clear();
    list(bound);
    std::sort(pairs_.begin(), pairs_.end(), [](const PartPair& x, const PartPair& y) {
      return std::tie(x.gap, x.first, x.second) < std::tie(y.gap, y.first, y.second);
    });
    // No pair can come closer than this.
    const double least = -std::max(a.state.parts().largest_threshold, b.state.parts().largest_threshold) -
                         a.largest_clearance() - b.largest_clearance();
    candidates_.clear();
    const auto settle = [&] {
      std::sort(candidates_.begin(), candidates_.end(),
                [](const Candidate& x, const Candidate& y) { return x.lower < y.lower; });
      for (const Candidate& c : candidates_) {
        if (c.lower > collector.cutoff() || (KeepsSmallest<C> && collector.cutoff() <= least)) break;
        const PrimitiveId i = a.primitive(c.slot_a), j = b.primitive(c.slot_b);
        judge.decide(i, j, a.placement.alone(i), b.placement.alone(j));
      }
      candidates_.clear();
      bound = std::min(bound, collector.cutoff());
    };
    if (KeepsSmallest<C> && least == 0.0) {
      // Whether anything collides at all is found sooner than what is closest, and then nothing is closer.
      for (const PartPair& pair : pairs_) {
        if (pair.gap > 0.0F || collector.cutoff() <= least) break;
        find_near(a, pair.first, b, pair.second, 0.0, judge, collector, counts);
      }
      bound = std::min(bound, collector.cutoff());
    }
    for (const PartPair& pair : pairs_) {
      if (collector.done() || (KeepsSmallest<C> && collector.cutoff() <= least)) break;
      const double extra = a.clearance_at(pair.first) + b.clearance_at(pair.second);
      // Boxes that overlap say nothing about how deep.
      if (pair.gap > 0.0F && static_cast<double>(pair.gap) / scale - extra > bound) {
        if (extra == 0.0) break;  // nearest first
        continue;
      }
      const float* const reach_a = a.state.parts().leaf_reach(0);
      const float* const reach_b = b.state.parts().leaf_reach(0);
      const double ratio = scale / b.state.parts().scale;
      closest_.run(a.state.parts(), a.part(pair.first), b.state.parts(), b.part(pair.second),
                   a.turn(pair.first, b, pair.second), a.scaled(bound + extra), counts,
                   [&](const auto& slots_a, const auto& slots_b, std::size_t n, const Bounds16& bounds) {
                     for (std::size_t k = 0; k < n; ++k) {
                       double reach = 0.0;
                       if (reach_a != nullptr) reach += static_cast<double>(reach_a[slots_a[k]]);
                       if (reach_b != nullptr) reach += static_cast<double>(reach_b[slots_b[k]]) * ratio;
                       reach = reach / scale + extra;
                       const double upper = static_cast<double>(bounds.upper[k]) / scale;
                       if (KeepsSmallest<C> && upper - reach < bound) {
                         const PrimitiveId i = a.primitive(slots_a[k]), j = b.primitive(slots_b[k]);
                         if (judge.admits(i, j)) bound = std::min(bound, upper - judge.threshold(i, j));
                       }
                       const double lower = static_cast<double>(bounds.lower[k]) / scale - reach;
                       if (lower <= bound) candidates_.push_back({slots_a[k], slots_b[k], lower});
                     }
                     if (!KeepsSmallest<C> || candidates_.size() >= most_candidates) settle();
                     return a.scaled(bound + extra);
                   });
    }
    settle();
    if constexpr (KeepsSmallest<C> && requires { collector.hit()->first; })
      if (collector.hit()) witnesses.remember(*collector.hit(), a.placement, b.placement);
  }

  struct Candidate {
    std::uint32_t slot_a, slot_b;
    double lower;  // of d - M, model unit
  };
  static constexpr std::size_t most_candidates = 1024;
  static constexpr std::size_t most_ordered = 1024;  // parts: the order takes the square of it in memory

  TreeState<P> state_;
  NearFinder<P> finder_;
  ClosestFinder<P> closest_;
  std::vector<PartPair> pairs_;
  std::vector<Candidate> candidates_;
  PairOrder order_;
  Witnesses<P> witnesses_, cross_witnesses_;
  std::weak_ptr<const TreeParts<P>> witnessed_;  // whose pairs cross_witnesses_ holds
};

/// Nothing of the trees is compiled for primitives that are never kept in them.
template <Primitive P>
using OptionalTreeSide = std::optional<std::conditional_t<KeepsTrees<P>, TreeSide<P>, std::monostate>>;

}  // namespace hinge
