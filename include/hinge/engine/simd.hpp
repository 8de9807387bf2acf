// SPDX-License-Identifier: BSD-3-Clause
// The SIMD engine: tests sixteen pairs at a time in float; a pair that floats cannot rule out is decided in double.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/engine/simd/broad_phase.hpp"
#include "hinge/detail/engine/simd/fallback_bvh.hpp"
#include "hinge/detail/engine/simd/measure.hpp"
#include "hinge/detail/engine/simd/narrow_phase.hpp"
#include "hinge/detail/engine/simd/pair_test.hpp"
#include "hinge/detail/engine/simd/simd_side.hpp"
#include "hinge/detail/engine/simd/simd_sides.hpp"
#include "hinge/detail/engine/simd/tree/tree_pair_test.hpp"
#include "hinge/detail/engine/simd/tree/tree_side.hpp"
#include "hinge/detail/engine/simd/work_budget.hpp"
#include "hinge/detail/query/test_pair.hpp"
#include "hinge/engine/engine.hpp"
#include "hinge/model/state.hpp"
#include "hinge/query/pair_rules.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge {

/// A rigid group of sixteen or more primitives keeps its blocks in its own frame; smaller groups share mixed blocks.
/// Entries are swept against earlier entries; candidates are tested one against sixteen. Floats only prove pairs apart.
/// If boxes or floats are too coarse, the query continues on a BVH in double precision. One engine per thread.
template <Primitive P, PairFilter F, DistanceMatrix D>
class Simd {
  using Side = detail::SimdSide<P>;

 public:
  /// `filter` and `matrix` are made for the primitives of `model`; both are copied.
  Simd(const SelectedModel<P>& model, F filter, D matrix)
      : filter_(std::move(filter)), matrix_(std::move(matrix)), sides_(model, matrix_) {
    if constexpr (detail::UsesStaticBvh<P>)
      trees_.emplace(std::make_shared<const detail::TreeParts<P>>(model, filter_, matrix_));
    else
      sides_.side(model, filter_, matrix_, false, detail::LeftOut::out_of_reach);
  }

  /// Hands the admitted pairs i < j within the cutoff to `collector` (see Collector), until it is done.
  template <Collector C>
  void self_query(const SelfRules<P, F, D>& rules, C& collector) {
    detail::WorkBudget budget;
    State<P>& state = rules.state;
    const QueryOptions& options = rules.options;
    if constexpr (detail::UsesStaticBvh<P>)
      if (by_trees(state)) {
        trees_->self_query(state, detail::tree_pair_test(collector, rules), collector, options, budget.counts);
        return budget.report(options.counts);
      }
    const auto idle = state.follows_joints() ? detail::LeftOut::out_of_reach : detail::LeftOut::never_colliding;
    Side& side = present_side(state, without_margin(collector, options) ? idle : detail::LeftOut::none);
    side.begin(state, options.moved_only, options.clearance);
    const detail::SelfPairTest test_pair{
        collector, rules, [&](PrimitiveId first, PrimitiveId second) { return rules.admits(first, second); }};
    if constexpr (C::ranks) {
      // The previous closest pair gives a first upper bound. test_pair decides whether it belongs to the answer.
      if (const auto pair = witness_)
        test_pair(pair->first, pair->second, side.exact(pair->first, state), side.exact(pair->second, state));
    }
    const detail::BlockLayout& layout = side.layout();
    budget.blocks_in = layout.block_count();
    begin();
    const detail::Identity<P> as_is;
    const auto run_listed = [&] { run(side, state, side, state, side.table(), as_is, test_pair, budget); };
    std::size_t patience = 1;
    float extent = -1.0F;
    double cutoff = 0.0;
    // Entries are ordered by the last group they need, but not if coordinates are given.
    const GroupRange range = state.groups_may_deform() ? GroupRange{} : options.groups;
    std::size_t u = side.blocks().first_entry();
    for (; u < layout.entries.size() && !collector.done() && !budget.is_too_much(); ++u) {
      if (id<GroupId>(layout.entries[u].least_from) >= range.end) {
        u = layout.entries.size();
        break;
      }
      side.refresh(u, state);
      if (u < layout.static_entries || id<GroupId>(layout.entries[u].last_group) < range.first) continue;
      // The margin depends on the cutoff and on the extent of the placed coordinates (a power of two).
      if (side.blocks().extent() != extent || collector.cutoff() != cutoff) {
        extent = side.blocks().extent();
        cutoff = collector.cutoff();
        set_thresholds(side, side, side.table(), as_is, cutoff);
      }
      if (!broad_phase_.within(side, u, state, thresholds_, budget.counts, relief(run_listed, collector, budget)))
        break;
      broad_phase_.resume_point.reach(u + 1);
      // The first runs are short: a hit near the root saves placing the rest. Longer runs cost less per candidate.
      if (broad_phase_.candidates.size() < patience) continue;
      patience = std::min(2 * patience, longest_run);
      run_listed();
    }
    if (!collector.done()) run_listed();
    if (u < layout.entries.size() && !collector.done()) {
      search_.place(layout, state, matrix_, options.clearance);
      const auto placed = state.placed();
      const detail::SelfPairTest rest{collector, rules, [&](PrimitiveId first, PrimitiveId second) {
                                        return !broad_phase_.resume_point.passed(layout, first, second) &&
                                               rules.admits(first, second);
                                      }};
      search_.within([&] { return collector.cutoff(); },
                     [&](PrimitiveId i, PrimitiveId j) {
                       rest(i, j, placed[index(i)], placed[index(j)]);
                       return !collector.done();
                     },
                     budget.searched);
    }
    if constexpr (C::ranks && requires { collector.hit()->first; })
      if (collector.hit()) witness_.emplace(collector.hit()->first, collector.hit()->second);
    budget.report(options.counts);
  }

  /// Records which pairs of links collide in the present state, to improve the order in which yes/no queries try pairs.
  /// Answers do not change. It has an effect only for primitives that are kept in static trees, such as triangles.
  void calibrate_pair_order(const SelfRules<P, F, D>& rules) {
    if constexpr (detail::UsesStaticBvh<P>) {
      if (!by_trees(rules.state)) return;
      AnyHit any;
      trees_->learn(rules.state, detail::tree_pair_test(any, rules), any);
    }
  }
  /// The same for yes/no queries against other models, represented by `other`: the order of this model's links.
  template <PairFilter G>
  requires CrossMatrix<D>
  void calibrate_pair_order(Simd& other, const CrossRules<P, G, D>& rules) {
    if constexpr (detail::UsesStaticBvh<P>) {
      if (!by_trees(other, rules)) return;
      AnyHit any;
      trees_->learn(rules.first, *other.trees_, rules.second, detail::tree_pair_test(any, rules), any);
    }
  }

  /// As self_query, for pairs between this model and the model of `other`.
  template <Collector C, PairFilter G>
  requires CrossMatrix<D>
  void query(Simd& other, const CrossRules<P, G, D>& rules, C& collector) {
    detail::WorkBudget budget;
    State<P>&state = rules.first, &other_state = rules.second;
    const QueryOptions& options = rules.options;
    if constexpr (detail::UsesStaticBvh<P>)
      if (by_trees(other, rules)) {
        trees_->query(state, *other.trees_, other_state, detail::tree_pair_test(collector, rules), collector, options,
                      budget.counts);
        return budget.report(options.counts);
      }
    const detail::CrossPairTest test_pair{collector, rules};
    // As in Lazy::query: typed matrices share a table; otherwise all thresholds of both models must be 0.
    const bool skip_never_colliding =
        without_margin(collector, options) &&
        (TypedThresholdMatrix<D> || (sides_.all_never_collide() && other.sides_.all_never_collide()));
    const auto left_out = skip_never_colliding ? detail::LeftOut::never_colliding : detail::LeftOut::none;
    Side &mine = present_side(state, left_out), &theirs = other.present_side(other_state, left_out);
    mine.begin(state, false, options.clearance);
    theirs.begin(other_state, false, options.other_clearance);
    for (std::size_t u = mine.blocks().first_entry(); u < mine.layout().entries.size(); ++u) mine.refresh(u, state);
    for (std::size_t u = theirs.blocks().first_entry(); u < theirs.layout().entries.size(); ++u)
      theirs.refresh(u, other_state);
    const detail::CrossModelTransform<P> into(mine, theirs);
    begin();
    const detail::ThresholdTable table = mine.parts().classes.table(theirs.parts().classes, theirs.layout().scale);
    set_thresholds(mine, theirs, table, into, collector.cutoff());
    const std::size_t entries = mine.layout().entries.size();
    budget.blocks_in = mine.layout().block_count() + theirs.layout().block_count();
    const auto run_listed = [&] { run(mine, state, theirs, other_state, table, into, test_pair, budget); };
    std::size_t u = 0;
    for (; into.holds() && u < entries && !collector.done() && !budget.is_too_much(); ++u) {
      if (!broad_phase_.across(mine, u, state, theirs, other_state, into, thresholds_, options.moved_only,
                               budget.counts, relief(run_listed, collector, budget)))
        break;
      broad_phase_.resume_point.reach(u + 1);
      run_listed();
    }
    if (!collector.done()) run_listed();
    if (u < entries && !collector.done()) {
      search_.place(mine.layout(), state, matrix_, options.clearance);
      other.search_.place(theirs.layout(), other_state, other.matrix_, options.other_clearance);
      search_.across(
          other.search_, [&] { return collector.cutoff(); },
          [&](PrimitiveId i, PrimitiveId j) {
            if (!broad_phase_.resume_point.passed(mine.layout(), i, theirs.layout(), j))
              test_pair(i, j, state.placed()[index(i)], other_state.placed()[index(j)]);
            return !collector.done();
          },
          budget.searched);
    }
    budget.report(options.counts);
  }

 private:
  void begin() noexcept {
    broad_phase_.candidates.clear();
    broad_phase_.resume_point.reach(0);
    visits_ = 0;
  }

  template <class Run, Collector C>
  auto relief(const Run& run_listed, const C& collector, const detail::WorkBudget& budget) {
    return [&] {
      if (broad_phase_.candidates.size() >= longest_list) run_listed();
      return !collector.done() && !budget.is_too_much();
    };
  }

  /// True when the query asks for collisions only: primitives that cannot collide can be skipped.
  template <Collector C>
  static bool without_margin(const C& collector, const QueryOptions& options) noexcept {
    return IsPointLike<P> && asks_collisions(collector) && !options.adds_clearance();
  }

  /// Returns true when the trees can answer. They cannot hold groups that deform.
  bool by_trees(const State<P>& state) const noexcept { return trees_.has_value() && !state.groups_may_deform(); }
  template <class Rules>
  bool by_trees(const Simd& other, const Rules& rules) const noexcept {
    return by_trees(rules.first) && other.by_trees(rules.second) && trees_->fits(*other.trees_);
  }

  Side& present_side(const State<P>& state, detail::LeftOut left_out) {
    return sides_.side(state.model(), filter_, matrix_, state.groups_may_deform(), left_out);
  }

  /// The margin covers cutoff and float error: no pair with d - M <= cutoff is lost. Clearances are added per pair.
  template <class Convert>
  void set_thresholds(const Side& one, const Side& sixteen, const detail::ThresholdTable& table, const Convert& convert,
                      double cutoff) noexcept {
    thresholds_.set(table,
                    detail::float_above(cutoff * sixteen.layout().scale + convert.band(one, sixteen, table, cutoff)));
  }
  /// Tests lanes of `one` against blocks of `sixteen`. Pairs that floats cannot rule out go to `test_pair`.
  template <class Convert, class TestPair>
  void run(Side& one, State<P>& state_of_one, Side& sixteen, State<P>& state_of_sixteen,
           const detail::ThresholdTable& table, const Convert& convert, const TestPair& test_pair,
           detail::WorkBudget& budget) {
    auto& collector = test_pair.collector;
    constexpr bool may_measure = detail::MeasuresDistances<P> && detail::AddsMeasured<TestPair>;
    detail::Measure measure;
    if constexpr (may_measure) measure = detail::Measure(one, sixteen, table, thresholds_, convert, collector.cutoff());
    budget.counts.pairs_tested += broad_phase_.candidates.size();
    const auto decide = [&](std::uint32_t at_one, std::uint32_t at_sixteen, detail::simd::Bits bits)
        __attribute__((always_inline)) {
      const std::uint32_t own = detail::slot<P>(at_one), first = detail::slot<P>(at_sixteen);
      const auto i = id<PrimitiveId>(one.layout().primitive[own]);
      const std::uint32_t* const others = sixteen.layout().primitive.data() + first;
      if constexpr (may_measure)
        if (measure.holds()) {
          const auto squared = convert(one.packed() + at_one).squared_distances(sixteen.packed() + at_sixteen);
          measure(i, others, bits, squared, test_pair);
          return !collector.done();
        }
      const double cutoff = collector.cutoff();
      // The first candidates with hits place only the primitives they need: one of them often answers the query.
      const bool few = visits_++ < placed_alone;
      constexpr auto n = static_cast<std::uint32_t>(detail::simd::width);
      const P& p = one.exact_block(own, detail::simd::Bits{1} << own % n, few, state_of_one)[own % n];
      const P* const q = sixteen.exact_block(first, bits, few, state_of_sixteen);
      const auto decide_lanes = [&](const auto& threshold) __attribute__((always_inline)) {
        for (; bits != 0 && !collector.done(); bits &= bits - 1) {
          const int k = std::countr_zero(bits);
          ++(test_pair(i, id<PrimitiveId>(others[k]), p, q[k], threshold(k)) ? budget.hits : budget.misses);
        }
      };
      if constexpr (TypedThresholdMatrix<D>)
        if (const double* const row = sixteen.has_extra() ? nullptr : one.exact_row(at_one)) {
          const std::uint8_t* const classes = sixteen.position_class() + at_sixteen;
          decide_lanes([&](int k) { return row[classes[k]]; });
        }
      decide_lanes([&](int k) { return test_pair.threshold(i, id<PrimitiveId>(others[k])); });
      if (collector.cutoff() != cutoff) set_thresholds(one, sixteen, table, convert, collector.cutoff());
      return !collector.done();
    };
    detail::NarrowPhase<P, Side, Convert> narrow(broad_phase_.candidates, one, sixteen, convert, thresholds_);
    narrow.each(collector.ranks, decide);
    broad_phase_.candidates.clear();
  }

  static constexpr std::size_t placed_alone = 4;  // candidates with hits whose primitives are placed one by one
  static constexpr std::size_t longest_run = 16 * detail::simd::width;  // longest run of candidates
  static constexpr std::size_t longest_list = 16 * longest_run;  // in a large entry: fits in the second-level cache

  F filter_;
  D matrix_;
  detail::OptionalTreeSide<P> trees_;
  detail::SimdSides<P> sides_;
  detail::BroadPhase<P> broad_phase_;  // scratch
  std::size_t visits_ = 0;             // scratch: candidates decided so far in a query
  detail::Thresholds16 thresholds_;    // scratch: thresholds plus the present margin
  detail::FallbackBvh search_;         // scratch
  std::optional<std::pair<PrimitiveId, PrimitiveId>> witness_;
};

}  // namespace hinge
