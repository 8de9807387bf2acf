// SPDX-License-Identifier: BSD-3-Clause
// BlockMoves: finds pairs that a move may have brought close, by moving blocks of floats and sweeping the moved blocks.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/engine/simd/candidate_list.hpp"
#include "hinge/detail/engine/simd/cross_model_transform.hpp"
#include "hinge/detail/engine/simd/exclusion_masks.hpp"
#include "hinge/detail/engine/simd/narrow_phase.hpp"
#include "hinge/detail/engine/simd/placed_blocks.hpp"
#include "hinge/detail/engine/simd/threshold_classes.hpp"
#include "hinge/detail/moves/move_blocks.hpp"
#include "hinge/detail/moves/move_frames.hpp"
#include "hinge/detail/moves/moved_blocks.hpp"
#include "hinge/detail/moves/moving_parts.hpp"
#include "hinge/detail/moves/near_rows.hpp"
#include "hinge/detail/moves/recent_collisions.hpp"
#include "hinge/detail/primitive/batch.hpp"
#include "hinge/moves/move_counts.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// For primitives whose batches can be transformed (TransformsBatch). Blocks of one part keep their relative placement
/// and are not tested with each other. Each block is swept against all blocks at rest and those of parts moved before.
template <Primitive P>
class BlockMoves {
 public:
  template <PairFilter F, DistanceMatrix D>
  BlockMoves(const SelectedModel<P>& model, const F& filter, const D& matrix, const MovingParts& parts)
      : BlockMoves(wide_parts(model, matrix), model, filter, parts) {}

  /// Places all blocks at a configuration.
  void set(std::span<const double> q, const MovingParts& parts) {
    frames_.set(q, parts);
    blocks_.forget_extent();
    for (std::uint32_t b = 0; b < layout().block_count(); ++b) blocks_.place(b, frames_.frames());
    blocks_.cover_all();
  }
  /// Changes joints to new values without testing pairs. `parts` are cut at these joints.
  void jump(std::span<const JointValue> values, const MovingParts& parts) {
    frames_.jump(values, parts);
    moved_.find(parts);
    for (const MovedBlocks::Range& range : moved_.whole())
      for (std::uint32_t r = range.begin; r < range.end; ++r) blocks_.place(blocks_.block(r), frames_.frames());
    for (const MovedBlocks::Cut& cut : moved_.cut()) blocks_.place(blocks_.block(cut.rank), frames_.frames());
    blocks_.cover_all();
  }

  /// True if floats can hold the present coordinates.
  bool holds() const noexcept { return std::isfinite(blocks_.extent()); }
  std::size_t block_count() const noexcept { return layout().block_count(); }

  /// Starts a move of joints to new values, at most most_kept. `parts` are cut at these joints. Returns the number of
  /// blocks that move.
  std::size_t begin(std::span<const JointValue> values, const MovingParts& parts) {
    frames_.try_values(values, parts);
    moved_.find(parts);
    motions_.resize(moved_.part_count());
    for (std::uint32_t part = 1; part < motions_.size(); ++part)
      motions_[part] = FloatMotion(frames_.transform(part), layout().origin, layout().scale);
    return moved_.count();
  }
  /// Call this between begin() and search(), with the same arguments. Returns true if a pair that stopped an earlier
  /// move surely collides again; passes that pair to visit(i, j).
  template <class Visit>
  bool recall(const MovingParts& parts, double cutoff, double motion_error, MoveCounts& counts,
              const Visit& visit) requires ComparesTwo<P> {
    set_thresholds(cutoff, motion_error);
    const auto slots = recent_.find(blocks_, motions_, thresholds_.margin(), parts);
    if (!slots) return false;
    ++counts.recalled;
    const auto [i, j] = std::minmax({blocks_.primitive_of_slot((*slots)[0]), blocks_.primitive_of_slot((*slots)[1])});
    visit(i, j);
    return true;
  }
  /// Calls visit(i, j) for every pair with d - M <= cutoff whose distance the move may have changed, and for some other
  /// pairs. visit must ask the filter; it returns false to stop. motion_error: model unit. search returns false if
  /// floats cannot hold the new coordinates: call reject() then.
  template <DistanceMatrix D, class Visit>
  bool search(const MovingParts& parts, const D& matrix, double cutoff, double motion_error, QueryCounts& counts,
              const Visit& visit);

  /// Accepts or drops the move.
  void accept(const MovingParts& parts);
  void reject() noexcept;

  MoveFrames& frames() noexcept { return frames_; }

 private:
  template <PairFilter F>
  BlockMoves(std::shared_ptr<const SimdParts<P>> simd_parts, const SelectedModel<P>& model, const F& filter,
             const MovingParts& parts)
      : table_(simd_parts->classes.table(simd_parts->layout.scale)),
        moved_(simd_parts->layout, model, parts),
        blocks_(simd_parts, model, parts, moved_.order()),
        frames_(model.groups(), parts),
        near_(std::make_shared<const NearRows>(ExclusionMasks(simd_parts->layout, model, filter, false),
                                               blocks_.ranks())),
        met_(simd_parts->layout.block_count() + 1) {}
  /// Leaves out primitives that never collide.
  template <DistanceMatrix D>
  static std::shared_ptr<const SimdParts<P>> wide_parts(const SelectedModel<P>& model, const D& matrix) {
    std::vector<std::uint8_t> never_collides;
    if constexpr (IsPointLike<P>) never_collides = zero_thresholds(matrix, model.size());
    return std::make_shared<const SimdParts<P>>(BlockLayout::by_groups(model, never_collides),
                                                ThresholdClasses(matrix, model.size()), model);
  }

  const BlockLayout& layout() const noexcept { return blocks_.layout(); }
  void set_thresholds(double cutoff, double motion_error) noexcept;
  void face(std::uint32_t b, std::size_t turned, std::span<const PartLanes> pieces, QueryCounts& counts);
  void face_itself(std::uint32_t b, std::span<const PartLanes> pieces);

  struct Met {
    std::uint32_t block, rank;
    simd::Bits in_b;
  };
  /// Longest run of candidates in the narrow phase: a hit among the first saves moving the other blocks.
  static constexpr std::size_t longest_run = 16 * simd::width;

  ThresholdTable table_;
  MovedBlocks moved_;
  MoveBlocks<P> blocks_;
  MoveFrames frames_;
  std::shared_ptr<const NearRows> near_;
  std::vector<FloatMotion> motions_;         // per part
  std::vector<std::uint32_t> turned_parts_;  // part of each moved block, except blocks cut by a joint
  std::vector<Met> met_;                     // scratch
  RecentCollisions recent_;
  CandidateList candidates_;
  Thresholds16 thresholds_;
  double cutoff_ = 0.0, motion_error_ = 0.0;  // the arguments that thresholds_ was computed from
  float extent_ = -1.0F;
};

template <Primitive P>
void BlockMoves<P>::set_thresholds(double cutoff, double motion_error) noexcept {
  if (extent_ == blocks_.extent() && cutoff_ == cutoff && motion_error_ == motion_error) return;
  extent_ = blocks_.extent();
  cutoff_ = cutoff;
  motion_error_ = motion_error;
  const double beyond = cutoff * layout().scale;
  thresholds_.set(table_,
                  float_above(beyond + blocks_.band(static_cast<double>(table_.largest) + beyond, motion_error)));
}

/// Lists the candidates of block b against all blocks at rest and the first `turned` moved blocks, as BroadPhase does.
/// pieces: the parts of b if it is cut by a joint; lanes that moved with the other block are left out.
template <Primitive P>
void BlockMoves<P>::face(std::uint32_t b, std::size_t turned, std::span<const PartLanes> pieces, QueryCounts& counts) {
  const float more = thresholds_.margin();
  const FloatBox& own = blocks_.box(b);
  const FloatBox probe = own.grown(more);
  const typename Batch<P>::Grown lanes(blocks_.floats(b), more + blocks_.reach(b));
  const BoxLanes box(own.grown(more + blocks_.largest_reach()));
  const simd::Bits real = layout().blocks[b].real;
  const auto apart_from = [&](std::uint32_t part) {
    for (const PartLanes& piece : pieces)
      if (piece.part == part) return real & ~piece.lanes;
    return real;
  };
  // Branch-free: most blocks have no lane of b nearby, which is unpredictable.
  std::size_t count = 0;
  const auto meet = [&](std::uint32_t rank, simd::Bits mine) __attribute__((always_inline)) {
    const std::uint32_t a = blocks_.block(rank);
    met_[count] = {a, rank, lanes.meets(blocks_.box(a)) & mine};
    count += met_[count].in_b != 0;
  };
  const simd::Bits moving = apart_from(0);
  for (const std::uint32_t rank : blocks_.standing(probe, counts)) meet(rank, moving);
  const std::size_t in_order = count;
  if (turned > 0)
    for (const std::uint32_t k : blocks_.turned(probe, turned, counts))
      meet(blocks_.rank(blocks_.turned()[k]), k < turned_parts_.size() ? apart_from(turned_parts_[k]) : real);
  const NearRows::Near* const first = near_->of(b);
  const NearRows::Near* near = first;
  for (std::size_t k = 0; k < count; ++k) {
    const auto& [a, rank, in_b] = met_[k];
    const simd::Bits real_a = layout().blocks[a].real;
    const simd::Bits in_a = Batch<P>::inside(blocks_.floats(a), box) & real_a;
    const bool b_by_one = std::popcount(in_b) <= std::popcount(in_a);
    const std::uint32_t one = blocks_.position(b_by_one ? b : a), sixteen = blocks_.position(b_by_one ? a : b);
    if (k >= in_order) near = first;
    while (near->partner < rank) ++near;
    if (near->partner == rank) [[unlikely]]
      candidates_.add_rows(b_by_one ? in_b : in_a, one, sixteen, near_->rows(b_by_one ? near->mine : near->its).data());
    else
      candidates_.add(b_by_one ? in_b : in_a, one, sixteen, b_by_one ? real_a : real);
  }
}

/// Lists the candidates between each piece of a cut block and the pieces after it.
template <Primitive P>
void BlockMoves<P>::face_itself(std::uint32_t b, std::span<const PartLanes> pieces) {
  simd::Bits rest = simd::all_bits;
  for (const PartLanes& piece : pieces.first(pieces.size() - 1)) {
    rest &= ~piece.lanes;
    LaneRows rows = near_->self(b);
    for (simd::Bits& row : rows) row &= rest;
    candidates_.add_rows(piece.lanes & layout().blocks[b].real, blocks_.position(b), blocks_.position(b), rows.data());
  }
}

template <Primitive P>
template <DistanceMatrix D, class Visit>
bool BlockMoves<P>::search(const MovingParts& parts, const D& matrix, double cutoff, double motion_error,
                           QueryCounts& counts, const Visit& visit) {
  const float extent = blocks_.extent();
  for (const MovedBlocks::Range& range : moved_.whole()) blocks_.hide(range.begin, range.end);
  for (const MovedBlocks::Cut& cut : moved_.cut()) blocks_.hide(cut.rank, cut.rank + 1);
  candidates_.clear();
  set_thresholds(cutoff, motion_error);
  bool wanted = true;
  const auto run = [&] {
    counts.pairs_tested += candidates_.size() * simd::width;
    NarrowPhase<P, MoveBlocks<P>, Identity<P>> narrow(candidates_, blocks_, blocks_, {}, thresholds_);
    narrow.each(false, [&](std::uint32_t one, std::uint32_t sixteen, simd::Bits bits) {
      for (; bits != 0 && wanted; bits &= bits - 1) {
        const std::uint32_t other = sixteen + static_cast<std::uint32_t>(std::countr_zero(bits));
        const std::uint32_t p = blocks_.slot(one), q = blocks_.slot(other);
        const PrimitiveId i = blocks_.primitive_of_slot(p), j = blocks_.primitive_of_slot(q);
        wanted = visit(i, j);
        if (wanted) continue;
        // Not the threshold of the classes of i and j, which may be larger.
        const double below = -matrix.threshold(i, j) * layout().scale;
        recent_.add({p, q}, {moved_.place(p), moved_.place(q)}, -float_above(below));
      }
      return wanted;
    });
    candidates_.clear();
  };
  std::size_t patience = 1;
  const auto face_it = [&](std::uint32_t b, std::size_t turned, std::span<const PartLanes> pieces) {
    if (blocks_.extent() != extent) {
      wanted = holds();
      if (!wanted) return;
      set_thresholds(cutoff, motion_error);
    }
    face(b, turned, pieces, counts);
    if (candidates_.size() < patience) return;
    patience = std::min(2 * patience, longest_run);
    run();
  };
  // Start with the parts farthest down the tree.
  turned_parts_.clear();
  for (std::uint32_t part = moved_.part_count(); wanted && part-- > 1;) {
    const std::span<const MovedBlocks::Range> ranges = moved_.of_part(part);
    const std::size_t before = turned_parts_.size();
    for (std::size_t k = ranges.size(); wanted && k-- > 0;)
      for (std::uint32_t r = ranges[k].end; wanted && r-- > ranges[k].begin;) {
        const std::uint32_t b = blocks_.block(r);
        blocks_.turn(b, motions_[part]);
        turned_parts_.push_back(part);
        face_it(b, before, {});
      }
  }
  // Blocks cut by joints come last: they hardly move against their neighbours, and cost most.
  for (std::size_t k = 0; wanted && k < moved_.cut().size(); ++k) {
    const std::uint32_t b = blocks_.block(moved_.cut()[k].rank);
    const std::span<const PartLanes> pieces = moved_.pieces(moved_.cut()[k], parts);
    blocks_.turn(b, pieces, motions_);
    face_itself(b, pieces);
    face_it(b, blocks_.turned().size() - 1, pieces);
  }
  if (wanted) run();
  if (holds()) return true;
  blocks_.restore_extent(extent);
  return false;
}

template <Primitive P>
void BlockMoves<P>::accept(const MovingParts& parts) {
  frames_.keep(parts);
  if (!blocks_.keep()) return;
  frames_.settle(parts);
  for (std::uint32_t b = 0; b < layout().block_count(); ++b)
    if (blocks_.is_worn(b)) blocks_.place(b, frames_.frames());
  blocks_.cover_all();
}

template <Primitive P>
void BlockMoves<P>::reject() noexcept {
  frames_.undo();
  blocks_.turn_back();
}

}  // namespace hinge::detail
