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
#include <vector>

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
    WideSide<P>& side = present_side();
    side.begin(placement_, options.moved_only, options.clearance);
    const auto decide = [&](PrimitiveId i, PrimitiveId j, const P& p, const P& q) __attribute__((always_inline)) {
      const bool turned = j < i;
      const PrimitiveId first = turned ? j : i, second = turned ? i : j;
      offer(collector, first, second, turned ? q : p, turned ? p : q, rules.threshold(first, second), [&] {
        // Blocks that hold listed exclusions are tested under masks.
        if constexpr (ListsExclusions<F>) return rules.counts(first, second);
        return rules.admits(first, second);
      });
    };
    if constexpr (C::ranks) {
      // The pair that was closest last time bounds the answer from the start; it is no part of the answer by itself.
      if (witness_)
        decide(witness_->first, witness_->second, exact(side, witness_->first), exact(side, witness_->second));
    }
    const BlockLayout& layout = side.layout();
    tasks_.clear();
    const auto run_listed = [&] {
      run(
          side, side, placement_, side.table(), Exactly<P>{}, [&] { return margin(side, collector.cutoff()); }, decide,
          collector, counts);
    };
    std::size_t patience = 1;
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
      // Soon at first: a hit at the root saves placing the rest. Then in longer
      // runs, which cost less.
      if (tasks_.size() < patience) continue;
      patience = std::min(2 * patience, longest_run);
      run_listed();
    }
    if (!collector.done()) run_listed();
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
    const auto decide = [&](PrimitiveId i, PrimitiveId j, const P& p, const P& q) {
      offer(collector, i, j, p, q, rules.threshold(i, j), [&] { return rules.admits(i, j); });
    };
    WideSide<P>&mine = present_side(), &theirs = other.present_side();
    mine.begin(placement_, false, options.clearance);
    theirs.begin(other.placement_, false, options.other_clearance);
    for (std::size_t u = 0; u < mine.layout().units.size(); ++u) mine.state().refresh(u, placement_);
    for (std::size_t u = 0; u < theirs.layout().units.size(); ++u) theirs.state().refresh(u, other.placement_);
    const double ratio = theirs.layout().scale / mine.layout().scale;
    if (!(ratio >= 0x1p-60 && ratio <= 0x1p60)) {
      // No float holds both models.
      for (std::size_t k = 0; k < placement_.model().size() && !collector.done(); ++k)
        for (std::size_t l = 0; l < other.placement_.model().size() && !collector.done(); ++l) {
          const auto i = id<PrimitiveId>(k), j = id<PrimitiveId>(l);
          decide(i, j, exact(mine, i), other.exact(theirs, j));
        }
      return add(options.counts, counts);
    }
    const Into<P> into(mine, theirs);
    const ThresholdTable table = mine.parts().classes.table(theirs.parts().classes, theirs.layout().scale);
    const auto between = [&] { return margin(mine, theirs, table, into, collector.cutoff()); };
    for (std::size_t u = 0; u < mine.layout().units.size() && !collector.done(); ++u) {
      thresholds_.set(table, between());
      collect_cross(mine, u, other, theirs, into, options.moved_only, counts);
      run(mine, theirs, other.placement_, table, into, between, decide, collector, counts);
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

  /// A primitive of this model in double.
  const P& exact(WideSide<P>& side, PrimitiveId i) noexcept {
    const std::uint32_t b = side.layout().block_of[index(i)];
    const std::uint32_t* const first = side.layout().primitive.data() + b * simd::width;
    return side.state().exact(b, placement_)[std::find(first, first + simd::width, index(i)) - first];
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

  /// A block held against others.
  struct Facing {
    Facing(WideSide<P>& side, std::uint32_t b, Placement<P>& placement, float more) noexcept
        : block(b),
          lanes(side.state().block(b, placement), more + side.parts().rigid.reach[b]),
          box(side.state().block_box(b).grown(more + side.parts().rigid.largest_reach)),
          partners(side.near(), b) {}
    std::uint32_t block;
    typename Batch<P>::Grown lanes;  // by its reach and more
    BoxLanes box;                    // by all reaches and more
    NearMasks::Partners partners;
  };

  /// Lists the tasks between a unit and the ones before it, and inside it.
  void collect_self(WideSide<P>& side, std::size_t u, QueryCounts& counts) {
    const Unit& unit = side.layout().units[u];
    const std::uint32_t first = unit.first_block;
    const simd::Bits lanes = side.near().self_lanes(first);
    if (lanes != 0 && !side.kept_apart(u, u))
      tasks_.add_rows(lanes, position(first), position(first), side.near().self_rows(first));
    const float more = thresholds_.margin() + side.extra(first) + side.largest_extra();
    const auto found = side.sweep(side.state().box(u).grown(more), unit.sweep_end, counts);
    if (found.empty()) return;
    if (unit.block_count == 1) {
      Facing facing(side, first, placement_, more);
      for (const std::uint32_t w : found) {
        if (side.kept_apart(u, w)) continue;
        const Unit& partner = side.layout().units[w];
        if (partner.block_count == 1) {
          add_pair(side, facing, partner.first_block, facing.partners.find(partner.first_block));
        } else {
          side.descend(w, side.state().block_box(first).grown(more), placement_, counts, theirs_);
          add_found(side, facing);
        }
      }
      return;
    }
    for (const std::uint32_t w : found) {
      if (side.kept_apart(u, w)) continue;
      side.descend(u, side.state().box(w).grown(more), placement_, counts, mine_);
      for (const std::uint32_t b : mine_) {
        // Placed only when it meets something.
        if (side.layout().units[w].block_count == 1)
          theirs_.assign(1, side.layout().units[w].first_block);
        else
          side.descend(w, side.state().tree_box(u, b, placement_).grown(more), placement_, counts, theirs_);
        if (theirs_.empty()) continue;
        add_found(side, Facing(side, b, placement_, more));
      }
    }
  }

  static std::uint32_t position(std::uint32_t block) noexcept {
    return block * static_cast<std::uint32_t>(Batch<P>::floats);
  }
  static std::uint32_t slot(std::uint32_t position) noexcept {
    constexpr auto floats = static_cast<std::uint32_t>(Batch<P>::floats);
    return position / floats * static_cast<std::uint32_t>(simd::width) + position % floats;
  }

  /// A block against those found in trees.
  [[gnu::noinline]] void add_found(WideSide<P>& side, const Facing& facing) {
    for (const std::uint32_t a : theirs_) add_pair(side, facing, a, side.near().find(facing.block, a));
  }

  /// A block against block a before it: whichever side has fewer primitives
  /// near the other's box goes one by one.
  [[gnu::always_inline]] void add_pair(WideSide<P>& side, const Facing& facing, std::uint32_t a,
                                       const simd::Bits* rows) {
    const float* at_a = side.state().block(a, placement_);
    const std::uint32_t b = facing.block;
    const simd::Bits real_b = side.layout().blocks[b].real, real_a = side.layout().blocks[a].real;
    const simd::Bits in_b = facing.lanes.meets(side.state().block_box(a)) & real_b;
    if (rows != nullptr) [[unlikely]]
      return tasks_.add_rows(in_b, position(b), position(a), rows);
    const simd::Bits in_a = Batch<P>::inside(at_a, facing.box) & real_a;
    // Without branches, which nobody could foretell: an empty side lists nothing.
    const bool b_by_one = std::popcount(in_b) <= std::popcount(in_a);
    tasks_.add(b_by_one ? in_b : in_a, position(b_by_one ? b : a), position(b_by_one ? a : b),
               b_by_one ? real_a : real_b);
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
    for (const std::uint32_t w : theirs.sweep(box, theirs.layout().units.size(), counts)) {
      if (stood_still && !moved(theirs, w, other.placement_)) continue;
      const Unit& partner = theirs.layout().units[w];
      const float own = m + extra + theirs.extra(partner.first_block);
      if (unit.block_count == 1)
        mine_.assign(1, unit.first_block);
      else
        mine.descend(u, into.back(theirs.state().box(w).grown(own)), placement_, counts, mine_);
      for (const std::uint32_t b : mine_) {
        const float* at = mine.state().block(b, placement_);
        const float more = own + mine.parts().rigid.reach[b] * into.scale;
        if (partner.block_count == 1)
          theirs_.assign(1, partner.first_block);
        else
          theirs.descend(w, into(mine.state().block_box(b)).grown(own), other.placement_, counts, theirs_);
        for (const std::uint32_t a : theirs_) {
          theirs.state().block(a, other.placement_);
          const FloatBox near = into.back(theirs.state().block_box(a).grown(more));
          const simd::Bits lanes = Batch<P>::inside(at, BoxLanes(near)) & mine.layout().blocks[b].real;
          if (lanes != 0) tasks_.add(lanes, position(b), position(a), theirs.layout().blocks[a].real);
        }
      }
    }
  }

  /// Runs the listed tasks: lanes of `one` against blocks of `sixteen`; what floats cannot rule out goes to `decide`.
  template <class Convert, class Margin, class Decide, Collector C>
  void run(WideSide<P>& one, WideSide<P>& sixteen, Placement<P>& placement_of_sixteen, const ThresholdTable& table,
           const Convert& convert, const Margin& present_margin, const Decide& decide, C& collector,
           QueryCounts& counts) {
    counts.pairs_tested += tasks_.size();
    run_tasks(
        tasks_, one, sixteen, convert, thresholds_,
        [&](std::uint32_t at_one, std::uint32_t at_sixteen, simd::Bits bits) __attribute__((always_inline)) {
          const std::uint32_t own = slot(at_one), first = slot(at_sixteen);
          const auto i = id<PrimitiveId>(one.layout().primitive[own]);
          const std::uint32_t* const others = sixteen.layout().primitive.data() + first;
          const P& p = one.state().exact(own / simd::width, placement_)[own % simd::width];
          const P* const q = sixteen.state().exact(first / simd::width, placement_of_sixteen);
          const double before = collector.cutoff();
          for (; bits != 0 && !collector.done(); bits &= bits - 1) {
            const int lane = std::countr_zero(bits);
            decide(i, id<PrimitiveId>(others[lane]), p, q[lane]);
          }
          if (collector.cutoff() != before) thresholds_.set(table, present_margin());
          return !collector.done();
        });
    tasks_.clear();
  }

  /// Tasks listed before they are run.
  static constexpr std::size_t longest_run = 16 * simd::width;

  Placement<P> placement_;
  F filter_;
  D matrix_;
  WideSide<P> by_groups_;
  std::optional<WideSide<P>> by_index_;       // made when coordinates from elsewhere first come
  Tasks tasks_;                               // scratch
  Thresholds16 thresholds_;                   // scratch: of the present margin
  std::vector<std::uint32_t> mine_, theirs_;  // scratch: blocks found in trees
  std::optional<std::pair<PrimitiveId, PrimitiveId>> witness_;
};

}  // namespace hinge
