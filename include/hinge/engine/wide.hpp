// SPDX-License-Identifier: BSD-3-Clause
// The wide engine: sixteen pairs at a time in float; pairs that floats cannot rule out are decided in double.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/engine/wide/box_search.hpp"
#include "hinge/detail/engine/wide/effort.hpp"
#include "hinge/detail/engine/wide/list_tasks.hpp"
#include "hinge/detail/engine/wide/measure.hpp"
#include "hinge/detail/engine/wide/run_tasks.hpp"
#include "hinge/detail/engine/wide/tree/tree_judge.hpp"
#include "hinge/detail/engine/wide/tree/tree_side.hpp"
#include "hinge/detail/engine/wide/verdicts.hpp"
#include "hinge/detail/engine/wide/wide_side.hpp"
#include "hinge/detail/engine/wide/wide_sides.hpp"
#include "hinge/detail/query/offer.hpp"
#include "hinge/detail/query/pair_rules.hpp"
#include "hinge/engine/engine.hpp"
#include "hinge/model/placement.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge {

/// Rigid groups of sixteen primitives or more keep blocks in their own frame, with a tree above them when they are
/// large; smaller groups share blocks that are refitted. Along the chain, each unit is placed, swept against the ones
/// before it, and what comes close is tested one against sixteen. Floats only ever prove that a pair is apart. A query
/// for which that would be too much, because boxes of blocks are as large as the model or floats too coarse, goes on
/// through trees of boxes in double.
template <Primitive P, PairFilter F, DistanceMatrix D>
class Wide {
  using Side = detail::WideSide<P>;

 public:
  Wide(std::shared_ptr<const SelectedModel<P>> model, F filter, D matrix)
      : placement_(model), filter_(std::move(filter)), matrix_(std::move(matrix)), sides_(*model, matrix_) {
    if constexpr (detail::KeepsTrees<P>)
      trees_.emplace(std::make_shared<const detail::TreeParts<P>>(*model, filter_, matrix_));
    else
      present_side(true);
  }

  Placement<P>& placement() noexcept { return placement_; }
  const Placement<P>& placement() const noexcept { return placement_; }

  template <Collector C>
  void self_query(C& collector, const QueryOptions& options) {
    detail::Effort effort;
    const detail::SelfRules<P, F, D> rules{placement_, filter_, matrix_, options};
    if constexpr (detail::KeepsTrees<P>)
      if (by_trees()) {
        trees_->self_query(placement_, tree_judge(collector, rules), collector, options, effort.counts);
        return effort.report(options.counts);
      }
    Side& side = present_side(without_margin(collector, options));
    side.begin(placement_, options.moved_only, options.clearance);
    const detail::SelfVerdicts decide{
        collector, rules, [&](PrimitiveId first, PrimitiveId second) { return rules.admits(first, second); }};
    if constexpr (C::ranks) {
      // The pair that was closest last time bounds the answer from the start; it is no part of the answer by itself.
      if (witness_)
        decide(witness_->first, witness_->second, side.exact(witness_->first, placement_),
               side.exact(witness_->second, placement_));
    }
    const detail::BlockLayout& layout = side.layout();
    effort.blocks_in = layout.block_count();
    begin();
    const auto listed_margin = [&] { return thresholds_.margin(); };
    const detail::Exactly<P> as_is;
    const auto run_listed = [&] { run(side, side, placement_, side.table(), as_is, decide, effort); };
    std::size_t patience = 1;
    float extent = -1.0F;
    double cutoff = 0.0;
    std::size_t u = side.state().first_unit();
    for (; u < layout.units.size() && !collector.done() && !effort.is_too_much(); ++u) {
      side.refresh(u, placement_);
      if (u < layout.static_units) continue;
      // Margins depend on the size of what was placed so far, in powers of two, and on the cutoff.
      if (side.state().extent() != extent || collector.cutoff() != cutoff) {
        extent = side.state().extent();
        cutoff = collector.cutoff();
        set_thresholds(side, side, side.table(), as_is, cutoff);
      }
      if (!lister_.within(side, u, placement_, listed_margin, effort.counts, relief(run_listed, collector, effort)))
        break;
      lister_.progress.reach(u + 1);
      // Soon at first: a hit at the root saves placing the rest. Then in longer runs, which cost less.
      if (lister_.tasks.size() < patience) continue;
      patience = std::min(2 * patience, longest_run);
      run_listed();
    }
    if (!collector.done()) run_listed();
    if (u < layout.units.size() && !collector.done()) {
      search_.place(layout, placement_, matrix_, options.clearance);
      const auto placed = placement_.placed();
      const detail::SelfVerdicts rest{collector, rules, [&](PrimitiveId first, PrimitiveId second) {
                                        return !lister_.progress.passed(layout, first, second) &&
                                               rules.admits(first, second);
                                      }};
      search_.within([&] { return collector.cutoff(); },
                     [&](PrimitiveId i, PrimitiveId j) {
                       rest(i, j, placed[index(i)], placed[index(j)]);
                       return !collector.done();
                     },
                     effort.searched);
    }
    if constexpr (C::ranks && requires { collector.hit()->first; })
      if (collector.hit()) witness_.emplace(collector.hit()->first, collector.hit()->second);
    effort.report(options.counts);
  }

  /// Learns, from the present state and those of earlier calls, in which order a yes/no query tries pairs of links.
  /// Answers stay the same; only models that are kept in trees have such an order.
  void learn_order() {
    if constexpr (detail::KeepsTrees<P>) {
      if (!by_trees()) return;
      AnyHit any;
      const QueryOptions options;
      const detail::SelfRules<P, F, D> rules{placement_, filter_, matrix_, options};
      trees_->learn(placement_, tree_judge(any, rules), any);
    }
  }
  /// The same for queries against other models, of which this one stands for all: the order of this model's links.
  template <PairFilter G>
  requires CrossMatrix<D>
  void learn_order(Wide& other, const G& across) {
    if constexpr (detail::KeepsTrees<P>) {
      if (!by_trees_with(other)) return;
      AnyHit any;
      const QueryOptions options;
      const detail::CrossRules<P, G, D> rules{placement_, other.placement_, across, matrix_, other.matrix_, options};
      trees_->learn(placement_, *other.trees_, other.placement_, tree_judge(any, rules), any);
    }
  }

  /// `across` admits (primitive of this, primitive of other).
  template <Collector C, PairFilter G>
  requires CrossMatrix<D>
  void query(Wide& other, const G& across, C& collector, const QueryOptions& options) {
    detail::Effort effort;
    const detail::CrossRules<P, G, D> rules{placement_, other.placement_, across, matrix_, other.matrix_, options};
    if constexpr (detail::KeepsTrees<P>)
      if (by_trees_with(other)) {
        trees_->query(placement_, *other.trees_, other.placement_, tree_judge(collector, rules), collector, options,
                      effort.counts);
        return effort.report(options.counts);
      }
    const detail::CrossVerdicts decide{collector, rules};
    // Compatible tables of types are alike; of other matrices nothing is known but that no threshold is above 0.
    const bool skip_idle =
        without_margin(collector, options) && (TypesPrimitives<D> || (sides_.all_idle() && other.sides_.all_idle()));
    Side &mine = present_side(skip_idle), &theirs = other.present_side(skip_idle);
    mine.begin(placement_, false, options.clearance);
    theirs.begin(other.placement_, false, options.other_clearance);
    for (std::size_t u = mine.state().first_unit(); u < mine.layout().units.size(); ++u) mine.refresh(u, placement_);
    for (std::size_t u = theirs.state().first_unit(); u < theirs.layout().units.size(); ++u)
      theirs.refresh(u, other.placement_);
    const detail::Into<P> into(mine, theirs);
    begin();
    const detail::ThresholdTable table = mine.parts().classes.table(theirs.parts().classes, theirs.layout().scale);
    set_thresholds(mine, theirs, table, into, collector.cutoff());
    const std::size_t units = mine.layout().units.size();
    effort.blocks_in = mine.layout().block_count() + theirs.layout().block_count();
    const auto run_listed = [&] { run(mine, theirs, other.placement_, table, into, decide, effort); };
    std::size_t u = 0;
    for (; into.holds() && u < units && !collector.done() && !effort.is_too_much(); ++u) {
      if (!lister_.across(
              mine, u, placement_, theirs, other.placement_, into, [&] { return thresholds_.margin(); },
              options.moved_only, effort.counts, relief(run_listed, collector, effort)))
        break;
      lister_.progress.reach(u + 1);
      run_listed();
    }
    if (!collector.done()) run_listed();
    if (u < units && !collector.done()) {
      search_.place(mine.layout(), placement_, matrix_, options.clearance);
      other.search_.place(theirs.layout(), other.placement_, other.matrix_, options.other_clearance);
      search_.across(
          other.search_, [&] { return collector.cutoff(); },
          [&](PrimitiveId i, PrimitiveId j) {
            if (!lister_.progress.passed(mine.layout(), i, theirs.layout(), j))
              decide(i, j, placement_.placed()[index(i)], other.placement_.placed()[index(j)]);
            return !collector.done();
          },
          effort.searched);
    }
    effort.report(options.counts);
  }

 private:
  void begin() noexcept {
    lister_.tasks.clear();
    lister_.progress.reach(0);
    visits_ = 0;
  }

  /// What listers call on the way.
  template <class Run, Collector C>
  auto relief(const Run& run_listed, const C& collector, const detail::Effort& effort) {
    return [&] {
      if (lister_.tasks.size() >= longest_list) run_listed();
      return !collector.done() && !effort.is_too_much();
    };
  }

  /// Does the query ask for collisions alone, so that primitives whose thresholds are all 0 take no part?
  template <Collector C>
  static bool without_margin(const C& collector, const QueryOptions& options) noexcept {
    return HasNoBody<P> && asks_collisions(collector) && !options.adds_clearance();
  }

  /// Are the trees up to the present coordinates? They cannot hold groups that deform.
  bool by_trees() const noexcept { return trees_.has_value() && !placement_.groups_may_deform(); }
  bool by_trees_with(const Wide& other) const noexcept {
    return by_trees() && other.by_trees() && trees_->fits(*other.trees_);
  }

  Side& present_side(bool without_margin) { return sides_.present(placement_, filter_, matrix_, without_margin); }

  /// Thresholds grow, as boxes do, so that floats lose no pair with d - M <= cutoff. Extra clearances come on top, per
  /// pair.
  template <class Convert>
  void set_thresholds(const Side& one, const Side& sixteen, const detail::ThresholdTable& table, const Convert& convert,
                      double cutoff) noexcept {
    thresholds_.set(table,
                    detail::float_above(cutoff * sixteen.layout().scale + convert.band(one, sixteen, table, cutoff)));
  }

  /// Runs the listed tasks: lanes of `one` against blocks of `sixteen`; what floats cannot rule out goes to `decide`.
  template <class Convert, class Decide>
  void run(Side& one, Side& sixteen, Placement<P>& placement_of_sixteen, const detail::ThresholdTable& table,
           const Convert& convert, const Decide& decide, detail::Effort& effort) {
    auto& collector = decide.collector;
    constexpr bool may_measure = detail::MeasuresDistances<P> && !std::remove_reference_t<decltype(collector)>::ranks;
    detail::Measure measure;
    if (may_measure && decide.rules.options.precision != Precision::exact)
      measure = detail::Measure(one, sixteen, table, thresholds_, convert, collector.cutoff());
    effort.counts.pairs_tested += lister_.tasks.size();
    run_tasks<P>(
        lister_.tasks, one, sixteen, convert, thresholds_,
        [&](std::uint32_t at_one, std::uint32_t at_sixteen, detail::simd::Bits bits,
            const detail::simd::Float16& squared) __attribute__((always_inline)) {
          const std::uint32_t own = detail::slot<P>(at_one), first = detail::slot<P>(at_sixteen);
          const auto i = id<PrimitiveId>(one.layout().primitive[own]);
          const std::uint32_t* const others = sixteen.layout().primitive.data() + first;
          const auto go_on = [&, before = collector.cutoff()] {
            if (collector.cutoff() != before) set_thresholds(one, sixteen, table, convert, collector.cutoff());
            return !collector.done();
          };
          if constexpr (may_measure)
            if (measure.holds()) {
              effort.counts.undecided += measure(i, others, bits, squared, decide);
              return go_on();
            }
          // For the first few only what they need is placed: often one of them answers the question.
          const bool few = visits_ < placed_alone;
          visits_ += few;
          constexpr auto n = static_cast<std::uint32_t>(detail::simd::width);
          const std::uint32_t b = own / n, a = first / n;
          const detail::simd::Bits alone = detail::simd::Bits{1} << own % n;
          const P& p = (few ? one.state().exact(b, alone, placement_) : one.state().exact(b, placement_))[own % n];
          const P* const q = few ? sixteen.state().exact(a, bits, placement_of_sixteen)
                                 : sixteen.state().exact(a, placement_of_sixteen);
          for (; bits != 0 && !collector.done(); bits &= bits - 1) {
            const int k = std::countr_zero(bits);
            ++(decide(i, id<PrimitiveId>(others[k]), p, q[k]) ? effort.hits : effort.misses);
          }
          return go_on();
        });
    lister_.tasks.clear();
  }

  static constexpr std::size_t placed_alone = 4;  // tasks with hits whose primitives are placed one by one
  static constexpr std::size_t longest_run = 16 * detail::simd::width;  // tasks listed before they are run
  /// Tasks that a large unit lists at a time: as many as second-level caches hold, whatever the unit's size.
  static constexpr std::size_t longest_list = 16 * longest_run;

  Placement<P> placement_;
  F filter_;
  D matrix_;
  detail::OptionalTreeSide<P> trees_;
  detail::WideSides<P> sides_;
  detail::TaskLister<P> lister_;     // scratch
  std::size_t visits_ = 0;           // scratch: tasks decided so far in a query, up to placed_alone
  detail::Thresholds16 thresholds_;  // scratch: of the present margin
  detail::BoxSearch search_;         // scratch
  std::optional<std::pair<PrimitiveId, PrimitiveId>> witness_;
};

}  // namespace hinge
