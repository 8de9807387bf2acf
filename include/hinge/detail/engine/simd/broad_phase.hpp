// SPDX-License-Identifier: BSD-3-Clause
// BroadPhase: turns overlapping boxes of entries into candidates "one primitive against a block of sixteen".
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/core/function_ref.hpp"
#include "hinge/detail/engine/simd/candidate_list.hpp"
#include "hinge/detail/engine/simd/cross_model_transform.hpp"
#include "hinge/detail/engine/simd/exclusion_masks.hpp"
#include "hinge/detail/engine/simd/narrow_phase.hpp"
#include "hinge/detail/engine/simd/resume_point.hpp"
#include "hinge/detail/engine/simd/simd_side.hpp"
#include "hinge/detail/primitive/batch.hpp"
#include "hinge/model/state.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// Position of a block's first float, and the slot of the primitive whose floats start at a position.
template <Primitive P>
std::uint32_t position(std::uint32_t block) noexcept {
  return block * static_cast<std::uint32_t>(Batch<P>::floats);
}
template <Primitive P>
std::uint32_t slot(std::uint32_t position) noexcept {
  constexpr auto floats = static_cast<std::uint32_t>(Batch<P>::floats);
  return position / floats * static_cast<std::uint32_t>(simd::width) + position % floats;
}

/// Pairs with d - M <= thresholds.margin() (plus extra clearances) must be listed; it may shrink during the sweep.
/// `relieve()` is called between the blocks of a large entry, whose candidates may be as many as its pairs. It returns
/// false to stop. within() and across() then return false too.
template <Primitive P>
class BroadPhase {
 public:
  using Relieve = FunctionRef<bool()>;

  CandidateList candidates;
  /// The caller reports finished entries. The broad phase stores the position where it stopped.
  ResumePoint resume_point;

  /// Lists the candidates between entry u and earlier entries, and inside u.
  bool within(SimdSide<P>& side, std::size_t u, State<P>& state, const Thresholds16& thresholds, QueryCounts& counts,
              Relieve relieve) {
    const SweepEntry& entry = side.layout().entries[u];
    const std::uint32_t first = entry.first_block;
    const NearRows16 self = side.near().self(first);
    if (self.lanes != 0 && !side.kept_apart(u, u))
      candidates.add_rows(self.lanes, position<P>(first), position<P>(first), self.rows);
    const auto found = side.entries().sweep(side.entries().get(u).grown(thresholds.margin()), entry.sweep_end, counts);
    if (found.empty()) return true;
    const float extra = side.extra(first);
    if (entry.block_count == 1) {
      Facing facing(side, first, state, thresholds.margin() + extra);
      for (const std::uint32_t w : found) {
        if (side.kept_apart(u, w)) continue;
        const SweepEntry& partner = side.layout().entries[w];
        if (partner.block_count == 1) {
          add_pair(side, facing, partner.first_block, facing.partners.find(partner.first_block), state);
        } else {
          const float more = thresholds.margin() + extra + side.extra(partner.first_block);
          side.descend(w, side.blocks().block_box(first).grown(more), state, counts, theirs_);
          add_found(side, facing, state);
        }
      }
      return true;
    }
    for (const std::uint32_t w : found) {
      if (side.kept_apart(u, w)) continue;
      const float both = extra + side.extra(side.layout().entries[w].first_block);
      side.descend(u, side.blocks().entries().get(w).grown(thresholds.margin() + both), state, counts, mine_);
      for (const std::uint32_t b : mine_) {
        const float near = thresholds.margin() + both;
        // The block itself is placed only if its box overlaps something.
        if (side.layout().entries[w].block_count == 1)
          theirs_.assign(1, side.layout().entries[w].first_block);
        else
          side.descend(w, side.blocks().tree_box(u, b, state).grown(near), state, counts, theirs_);
        if (theirs_.empty()) continue;
        add_found(side, Facing(side, b, state, thresholds.margin() + extra), state);
        if (!relieve()) return stop(w, b);
      }
    }
    return true;
  }

  /// Lists the candidates between an entry and the other model. `into` transforms coordinates into that model.
  bool across(SimdSide<P>& mine, std::size_t u, State<P>& state, SimdSide<P>& theirs, State<P>& other_state,
              const CrossModelTransform<P>& into, const Thresholds16& thresholds, bool moved_only, QueryCounts& counts,
              Relieve relieve) {
    const SweepEntry& entry = mine.layout().entries[u];
    const float extra = mine.extra(entry.first_block) * into.scale;
    const FloatBox box = into(mine.blocks().entries().get(u)).grown(thresholds.margin() + extra);
    const bool stood_still = moved_only && !mine.moved(u, state);
    for (const std::uint32_t w : theirs.entries().sweep(box, theirs.layout().entries.size(), counts)) {
      if (stood_still && !theirs.moved(w, other_state)) continue;
      const SweepEntry& partner = theirs.layout().entries[w];
      const float extras = extra + theirs.extra(partner.first_block);
      if (entry.block_count == 1)
        mine_.assign(1, entry.first_block);
      else
        mine.descend(u, into.back(theirs.blocks().entries().get(w).grown(thresholds.margin() + extras)), state, counts,
                     mine_);
      for (const std::uint32_t b : mine_) {
        const float own = thresholds.margin() + extras;
        const float* at = mine.blocks().block(b, state);
        const float more = own + mine.parts().rigid.reach[b] * into.scale;
        if (partner.block_count == 1)
          theirs_.assign(1, partner.first_block);
        else
          theirs.descend(w, into(mine.blocks().block_box(b)).grown(own), other_state, counts, theirs_);
        for (const std::uint32_t a : theirs_) {
          theirs.blocks().block(a, other_state);
          const FloatBox near = into.back(theirs.blocks().block_box(a).grown(more));
          const simd::Bits lanes = Batch<P>::inside(at, BoxLanes(near)) & mine.layout().blocks[b].real;
          candidates.add(lanes, position<P>(b), position<P>(a), theirs.layout().blocks[a].real);
        }
        if (!relieve()) return stop(w, b);
      }
    }
    return true;
  }

 private:
  /// Stops: blocks of mine_ up to b were swept against partner w.
  bool stop(std::size_t w, std::uint32_t b) {
    resume_point.stop(w, {mine_.begin(), std::find(mine_.begin(), mine_.end(), b) + 1});
    return false;
  }

  /// A block prepared for tests against many others. `more` is the margin plus its extra clearance.
  struct Facing {
    Facing(SimdSide<P>& side, std::uint32_t b, State<P>& state, float more) noexcept
        : block(b),
          lanes(side.blocks().block(b, state), more + side.parts().rigid.reach[b]),
          box(side.blocks().block_box(b).grown(more + side.parts().rigid.largest_reach)),
          partners(side.near(), b) {}
    std::uint32_t block;
    typename Batch<P>::Grown lanes;  // inflated by the block's reach and `more`
    BoxLanes box;                    // inflated by its own reach, the largest reach of all blocks, and `more`
    ExclusionMasks::Partners partners;
  };

  /// Lists the candidates between a block and the blocks found in a tree.
  [[gnu::noinline]] void add_found(SimdSide<P>& side, const Facing& facing, State<P>& state) {
    for (const std::uint32_t a : theirs_) add_pair(side, facing, a, side.near().find(facing.block, a), state);
  }

  /// Lists the candidates between block b and an earlier block a. The side with fewer primitives near the other's box
  /// is listed one by one.
  [[gnu::always_inline]] void add_pair(SimdSide<P>& side, const Facing& facing, std::uint32_t a, const NearRows16& near,
                                       State<P>& state) {
    if (near.lanes == 0) [[unlikely]]
      return;
    const float* at_a = side.blocks().block(a, state);
    const std::uint32_t b = facing.block;
    const simd::Bits real_b = side.layout().blocks[b].real, real_a = side.layout().blocks[a].real;
    const FloatBox& box_a = side.blocks().block_box(a);
    // Inflating by zero is measurable here; skip it.
    const simd::Bits in_b =
        (side.has_extra() ? facing.lanes.meets(box_a.grown(side.extra(a))) : facing.lanes.meets(box_a)) & real_b;
    if (near.rows != nullptr) [[unlikely]]
      return candidates.add_rows(in_b & near.lanes, position<P>(b), position<P>(a), near.rows);
    const simd::Bits in_a = (side.has_extra() ? Batch<P>::inside(at_a, facing.box.grown(side.extra(a)))
                                              : Batch<P>::inside(at_a, facing.box)) &
                            real_a;
    // Branch-free: the branch is unpredictable. An empty side lists nothing.
    const bool b_by_one = std::popcount(in_b) <= std::popcount(in_a);
    candidates.add(b_by_one ? in_b : in_a, position<P>(b_by_one ? b : a), position<P>(b_by_one ? a : b),
                   b_by_one ? real_a : real_b);
  }

  std::vector<std::uint32_t> mine_, theirs_;  // blocks found in trees
};

}  // namespace hinge::detail
