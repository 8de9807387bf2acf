// SPDX-License-Identifier: BSD-3-Clause
// engine/wide: blocks of sixteen in float, swept and tested side by side; what floats cannot rule out is decided in
// double.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "hinge/core/id.hpp"
#include "hinge/engine/engine.hpp"
#include "hinge/engine/wide/run_tasks.hpp"
#include "hinge/engine/wide/tasks.hpp"
#include "hinge/engine/wide/wide_side.hpp"
#include "hinge/model/placement.hpp"
#include "hinge/query/offer.hpp"
#include "hinge/query/pair_rules.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge {

/// Rigid groups of sixteen primitives or more keep blocks in their own frame, with a tree above them when they are
/// large; smaller groups share blocks that are refitted. Along the chain, each unit is placed, swept against the ones
/// before it, and what comes close is tested one against sixteen. Floats only ever prove that a pair is apart.
template <Primitive P, PairFilter F, DistanceMatrix D>
class Wide {
 public:
  Wide(std::shared_ptr<const SelectedModel<P>> model, F filter, D matrix)
      : placement_(model),
        filter_(std::move(filter)),
        matrix_(std::move(matrix)),
        by_groups_(std::make_shared<const WideParts<P>>(BlockLayout::by_groups(*model),
                                                        ThresholdClasses(matrix_, model->size()), *model),
                   *model, filter_, false) {}

  Placement<P>& placement() noexcept { return placement_; }
  const Placement<P>& placement() const noexcept { return placement_; }

  template <Collector C>
  void self_query(C& collector, const QueryOptions& options) {
    QueryCounts counts;
    const SelfRules<P, F, D> rules{placement_, filter_, matrix_, options};
    const auto decide = [&](PrimitiveId i, PrimitiveId j) {
      if (j < i) std::swap(i, j);
      offer(collector, i, j, placement_.at(i), placement_.at(j), rules.threshold(i, j), [&] {
        if constexpr (ListsExclusions<F>) return rules.counts(i, j);
        return rules.admits(i, j);
      });
    };
    if constexpr (C::ranks) {
      // The pair that was closest last time bounds the answer from the start; it is no part of the answer by itself.
      if (witness_)
        offer(collector, witness_->first, witness_->second, placement_.at(witness_->first),
              placement_.at(witness_->second), rules.threshold(witness_->first, witness_->second),
              [&] { return rules.admits(witness_->first, witness_->second); });
    }
    WideSide<P>& side = present_side();
    side.begin(placement_, options.moved_only, options.clearance);
    const BlockLayout& layout = side.layout();
    float extent = -1.0F;
    double cutoff = 0.0;
    for (std::size_t u = 0; u < layout.units.size() && !collector.done(); ++u) {
      side.state().refresh(u, placement_);
      if (u < layout.static_units) continue;
      // Margins depend on the size of what was placed so far, in powers of two, and on the cutoff.
      if (side.state().extent() != extent || collector.cutoff() != cutoff) {
        extent = side.state().extent();
        cutoff = collector.cutoff();
        thresholds_.set(side.table(), margin(side, cutoff));
      }
      collect_self(side, u, counts);
      run(
          side, side, side.table(), Exactly<P>{}, [&] { return margin(side, collector.cutoff()); }, decide, collector,
          counts);
    }
    if constexpr (C::ranks)
      if (collector.hit()) witness_.emplace(collector.hit()->first, collector.hit()->second);
    add(options.counts, counts);
  }

  /// `across` admits (primitive of this, primitive of other).
  template <Collector C, PairFilter G>
  requires CrossMatrix<D>
  void query(Wide& other, const G& across, C& collector, const QueryOptions& options) {
    QueryCounts counts;
    const CrossRules<P, G, D> rules{placement_, other.placement_, across, matrix_, other.matrix_, options};
    const auto decide = [&](PrimitiveId i, PrimitiveId j) {
      offer(collector, i, j, placement_.at(i), other.placement_.at(j), rules.threshold(i, j),
            [&] { return rules.admits(i, j); });
    };
    WideSide<P>&mine = present_side(), &theirs = other.present_side();
    mine.begin(placement_, false, options.clearance);
    theirs.begin(other.placement_, false, options.other_clearance);
    for (std::size_t u = 0; u < mine.layout().units.size(); ++u) mine.state().refresh(u, placement_);
    for (std::size_t u = 0; u < theirs.layout().units.size(); ++u) theirs.state().refresh(u, other.placement_);
    const Into<P> into(mine, theirs);
    const ThresholdTable table = mine.parts().classes.table(theirs.parts().classes, theirs.layout().scale);
    const auto between = [&] { return margin(mine, theirs, table, into, collector.cutoff()); };
    for (std::size_t u = 0; u < mine.layout().units.size() && !collector.done(); ++u) {
      thresholds_.set(table, between());
      collect_cross(mine, u, other, theirs, into, options.moved_only, counts);
      run(mine, theirs, table, into, between, decide, collector, counts);
    }
    add(options.counts, counts);
  }

 private:
  WideSide<P>& present_side() {
    if (!placement_.groups_may_deform()) return by_groups_;
    if (!by_index_) {
      const SelectedModel<P>& model = placement_.model();
      by_index_.emplace(std::make_shared<const WideParts<P>>(BlockLayout::by_index(model),
                                                             ThresholdClasses(matrix_, model.size()), model),
                        model, filter_, true);
    }
    return *by_index_;
  }

  static void add(QueryCounts* total, const QueryCounts& counts) noexcept {
    if (total == nullptr) return;
    total->boxes_tested += counts.boxes_tested * simd::width;
    total->pairs_tested += counts.pairs_tested * simd::width;
  }

  /// What is added to thresholds and boxes so that floats lose no pair with d - M <= cutoff. Extra clearances come on
  /// top, per pair.
  static float margin(WideSide<P>& side, double cutoff) noexcept {
    const double scaled = cutoff * side.layout().scale;
    const double largest =
        static_cast<double>(side.table().largest) + std::abs(scaled) + 2 * static_cast<double>(side.largest_extra());
    return float_above(scaled + side.state().band(largest));
  }
  static float margin(WideSide<P>& mine, WideSide<P>& theirs, const ThresholdTable& table, const Into<P>& into,
                      double cutoff) noexcept {
    const double scaled = cutoff * theirs.layout().scale, ratio = static_cast<double>(into.scale);
    double largest = static_cast<double>(table.largest) + std::abs(scaled) +
                     static_cast<double>(theirs.largest_extra()) + ratio * static_cast<double>(mine.largest_extra());
    // Shifting rounds once more, by the size of what is shifted.
    for (const float s : into.shift) largest += 2 * std::abs(static_cast<double>(s));
    return float_above(scaled + theirs.state().band(largest) + 2 * ratio * mine.state().band(0.0));
  }

  /// Lists the tasks between a unit and the ones before it, and inside it.
  void collect_self(WideSide<P>& side, std::size_t u, QueryCounts& counts) {
    tasks_.clear();
    const Unit& unit = side.layout().units[u];
    const std::uint32_t first = unit.first_block;
    const float m = thresholds_.margin();
    if (const simd::Bits lanes = side.near().self_lanes(first); lanes != 0 && !side.kept_apart(u, u))
      tasks_.add_rows(lanes, first * static_cast<std::uint32_t>(simd::width), first, side.near().self_rows(first));
    const float reach = m + side.extra(first) + side.largest_extra();
    side.sweep(side.state().box(u).grown(reach), unit.sweep_end, counts, [&](std::uint32_t w) {
      if (side.kept_apart(u, w)) return;
      const Unit& partner = side.layout().units[w];
      const float own = m + side.extra(first) + side.extra(partner.first_block);
      if (unit.block_count == 1) {
        meet(side, first, w, own, counts);
      } else if (partner.block_count == 1) {
        side.state().block(partner.first_block, placement_);
        side.descend(u, reached(side, partner.first_block, own), placement_, counts,
                     [&](std::uint32_t b) { add_pair(side, b, partner.first_block, own); });
      } else {
        side.descend(u, side.state().box(w).grown(own), placement_, counts,
                     [&](std::uint32_t b) { meet(side, b, w, own, counts); });
      }
    });
  }

  /// A block against all of an earlier unit.
  void meet(WideSide<P>& side, std::uint32_t b, std::size_t w, float own, QueryCounts& counts) {
    const Unit& partner = side.layout().units[w];
    if (partner.block_count == 1) return add_pair(side, b, partner.first_block, own);
    side.state().block(b, placement_);
    side.descend(w, reached(side, b, own), placement_, counts, [&](std::uint32_t a) { add_pair(side, b, a, own); });
  }

  /// The box of a placed block, grown by its reach and more.
  static FloatBox reached(WideSide<P>& side, std::uint32_t b, float more) noexcept {
    return side.state().block_box(b).grown(side.parts().rigid.reach[b] + more);
  }

  /// Block b against block a < b: whichever side has fewer primitives near the other's box goes one by one.
  void add_pair(WideSide<P>& side, std::uint32_t b, std::uint32_t a, float own) {
    const float* at_b = side.state().block(b, placement_);
    const float* at_a = side.state().block(a, placement_);
    const float both = side.parts().rigid.reach[a] + side.parts().rigid.reach[b] + own;
    const NearMasks& near = side.near();
    const simd::Bits in_b = Batch<P>::inside(at_b, side.state().block_box(a).grown(both)) & near.mask(b);
    if (in_b == 0) return;
    constexpr auto n = static_cast<std::uint32_t>(simd::width);
    const std::uint32_t rows = near.find(b, a);
    if (rows != NearMasks::none) return tasks_.add_rows(in_b, b * n, a, rows);
    const simd::Bits in_a = Batch<P>::inside(at_a, side.state().block_box(b).grown(both)) & near.mask(a);
    if (in_a == 0) return;
    if (std::popcount(in_b) <= std::popcount(in_a))
      tasks_.add(in_b, b * n, a, a);
    else
      tasks_.add(in_a, a * n, b, b);
  }

  /// Lists the tasks of a unit against another model.
  void collect_cross(WideSide<P>& mine, std::size_t u, Wide& other, WideSide<P>& theirs, const Into<P>& into,
                     bool moved_only, QueryCounts& counts) {
    tasks_.clear();
    const float m = thresholds_.margin();
    const Unit& unit = mine.layout().units[u];
    const float extra = mine.extra(unit.first_block) * into.scale;
    const FloatBox box = into(mine.state().box(u)).grown(m + extra + theirs.largest_extra());
    const auto moved = [&](WideSide<P>& side, std::size_t w, Placement<P>& placement) {
      for (const GroupId g : side.layout().groups_of(side.layout().blocks[side.layout().units[w].first_block]))
        if (placement.moved(g)) return true;
      return false;
    };
    const bool stood_still = moved_only && !moved(mine, u, placement_);
    theirs.sweep(box, theirs.layout().units.size(), counts, [&](std::uint32_t w) {
      if (stood_still && !moved(theirs, w, other.placement_)) return;
      const Unit& partner = theirs.layout().units[w];
      const float own = m + extra + theirs.extra(partner.first_block);
      const auto with_block = [&](std::uint32_t b) {
        const float* at = mine.state().block(b, placement_);
        const float reach = mine.parts().rigid.reach[b] * into.scale + own;
        const auto pair = [&](std::uint32_t a) {
          theirs.state().block(a, other.placement_);
          const FloatBox near = theirs.state().block_box(a).grown(reach + theirs.parts().rigid.reach[a]);
          const simd::Bits lanes = Batch<P>::inside(at, into.back(near)) & mine.near().mask(b);
          if (lanes != 0) tasks_.add(lanes, b * static_cast<std::uint32_t>(simd::width), a, a);
        };
        if (partner.block_count == 1) return pair(partner.first_block);
        theirs.descend(w, into(mine.state().block_box(b)).grown(reach), other.placement_, counts, pair);
      };
      if (unit.block_count == 1) return with_block(unit.first_block);
      mine.descend(u, into.back(theirs.state().box(w).grown(own)), placement_, counts, with_block);
    });
  }

  /// Runs the listed tasks: lanes of `one` against blocks of `sixteen`; what floats cannot rule out goes to `decide`.
  template <class Convert, class Margin, class Decide, Collector C>
  void run(WideSide<P>& one, WideSide<P>& sixteen, const ThresholdTable& table, const Convert& convert,
           const Margin& present_margin, const Decide& decide, C& collector, QueryCounts& counts) {
    counts.pairs_tested += tasks_.size();
    run_tasks(tasks_, one, sixteen, convert, thresholds_,
              [&](std::uint32_t slot, std::uint32_t block, simd::Bits bits) {
                const auto i = id<PrimitiveId>(one.layout().primitive[slot]);
                const double before = collector.cutoff();
                for (; bits != 0 && !collector.done(); bits &= bits - 1) {
                  const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
                  decide(i, id<PrimitiveId>(sixteen.layout().primitive[block * simd::width + lane]));
                }
                if (collector.cutoff() != before) thresholds_.set(table, present_margin());
                return !collector.done();
              });
  }

  Placement<P> placement_;
  F filter_;
  D matrix_;
  WideSide<P> by_groups_;
  std::optional<WideSide<P>> by_index_;  // made when coordinates from elsewhere first come
  Tasks tasks_;                          // scratch
  Thresholds16 thresholds_;              // scratch: of the present margin
  std::optional<std::pair<PrimitiveId, PrimitiveId>> witness_;
};

}  // namespace hinge
