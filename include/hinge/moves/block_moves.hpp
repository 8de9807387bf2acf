// SPDX-License-Identifier: BSD-3-Clause
// BlockMoves: the pairs that a move may have brought close, found by turning blocks of floats and sweeping what turned.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/engine/wide/into.hpp"
#include "hinge/engine/wide/near_masks.hpp"
#include "hinge/engine/wide/run_tasks.hpp"
#include "hinge/engine/wide/tasks.hpp"
#include "hinge/engine/wide/threshold_classes.hpp"
#include "hinge/engine/wide/wide_state.hpp"
#include "hinge/moves/move_blocks.hpp"
#include "hinge/moves/move_frames.hpp"
#include "hinge/moves/moved_blocks.hpp"
#include "hinge/moves/moving_parts.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/primitive/batch.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge {

/// For primitives whose batches turn (TurnsBatch). Blocks of one part keep their mutual placement and never meet: they
/// are hidden while they are swept, each against all that stands still or was turned before.
template <Primitive P>
class BlockMoves {
 public:
  template <PairFilter F, DistanceMatrix D>
  BlockMoves(const SelectedModel<P>& model, const F& filter, const D& matrix, const MovingParts& parts)
      : BlockMoves(wide_parts(model, matrix), model, filter, parts) {}

  /// Everything is placed anew.
  void set(std::span<const double> q, const MovingParts& parts) {
    frames_.set(q, parts);
    blocks_.forget_extent();
    for (std::uint32_t b = 0; b < layout().block_count(); ++b) {
      blocks_.place(b, frames_.frames());
      blocks_.show(b);
    }
    cover_all();
  }
  /// Moves to other values of joints, which `parts` are cut at, without asking for pairs.
  void jump(std::span<const JointValue> values, const MovingParts& parts) {
    frames_.try_values(values, parts);
    frames_.keep(parts);
    moved_.find(parts);
    for (const auto& some : {moved_.whole(), moved_.cut()})
      for (const std::uint32_t b : some) {
        blocks_.place(b, frames_.frames());
        blocks_.show(b);
      }
    cover_moved();
  }

  /// Can floats hold the present coordinates?
  bool holds() const noexcept { return std::isfinite(blocks_.extent()); }
  std::size_t block_count() const noexcept { return layout().block_count(); }

  /// Moves joints to other values, `parts` being cut at them; returns the number of blocks that this takes along.
  std::size_t begin(std::span<const JointValue> values, const MovingParts& parts) {
    frames_.try_values(values, parts);
    moved_.find(parts);
    turned_ = 0;
    return moved_.count();
  }

  /// Offers every pair with d - M <= cutoff whose distance the move may have changed, and others, to
  /// visit(i, j), which answers false to stop. Exclusions that a filter lists were regarded. motion_error: model unit.
  /// False when floats cannot hold the new coordinates: take the move back then.
  template <class Visit>
  bool search(double cutoff, double motion_error, QueryCounts& counts, const Visit& visit);

  /// The move stays, or is taken back.
  void accept(const MovingParts& parts);
  void reject() noexcept;

  MoveFrames& frames() noexcept { return frames_; }

 private:
  template <PairFilter F>
  BlockMoves(std::shared_ptr<const WideParts<P>> wide, const SelectedModel<P>& model, const F& filter,
             const MovingParts& parts)
      : near_(std::make_shared<const NearMasks>(wide->layout, model, filter, false)),
        table_(wide->classes.table(wide->layout.scale)),
        blocks_(wide, parts),
        moved_(wide->layout, model, parts),
        frames_(model.groups(), parts) {
    // A pair of near blocks is listed for both.
    std::vector<std::vector<Near>> lists(layout().block_count());
    for (std::uint32_t b = 0; b < lists.size(); ++b)
      for (const std::uint32_t a : near_->partners(b))
        if (a != b) {
          lists[b].push_back({a, near_->find(b, a)});
          lists[a].push_back({b, near_->find(b, a)});
        }
    for (auto& list : lists) {
      near_start_.push_back(static_cast<std::uint32_t>(near_list_.size()));
      std::sort(list.begin(), list.end(), [](const Near& x, const Near& y) { return x.partner < y.partner; });
      near_list_.insert(near_list_.end(), list.begin(), list.end());
      near_list_.push_back({std::numeric_limits<std::uint32_t>::max(), nullptr});
    }
  }
  /// Primitives that no pair can hold are left out.
  template <DistanceMatrix D>
  static std::shared_ptr<const WideParts<P>> wide_parts(const SelectedModel<P>& model, const D& matrix) {
    std::vector<std::uint8_t> idle;
    if constexpr (HasNoBody<P>) idle = zero_thresholds(matrix, model.size());
    return std::make_shared<const WideParts<P>>(BlockLayout::by_groups(model, idle),
                                                ThresholdClasses(matrix, model.size()), model);
  }

  const BlockLayout& layout() const noexcept { return blocks_.layout(); }
  void set_thresholds(double cutoff, double motion_error) noexcept;
  void face(std::uint32_t b, QueryCounts& counts);
  void cover_all() noexcept {
    for (std::uint32_t b = 0; b < block_count(); b += simd::width) blocks_.cover(b);
  }
  void cover_moved() noexcept {
    for (const auto& some : {moved_.whole(), moved_.cut()}) cover(some);
  }
  void cover(std::span<const std::uint32_t> some) noexcept {
    if (block_count() <= simd::width * simd::width) return;  // no boxes above rows
    std::size_t row = block_count();
    for (const std::uint32_t b : some)
      if (std::exchange(row, b / simd::width) != b / simd::width) blocks_.cover(b);
  }

  struct Near {
    std::uint32_t partner;
    const simd::Bits* rows;
  };
  /// Tasks listed before they are run: a hit among the first saves turning the rest.
  static constexpr std::size_t longest_run = 16 * simd::width;

  std::shared_ptr<const NearMasks> near_;
  ThresholdTable table_;
  MoveBlocks<P> blocks_;
  MovedBlocks moved_;
  MoveFrames frames_;
  std::vector<Near> near_list_;  // per block, by partner, with an end
  std::vector<std::uint32_t> near_start_;
  std::vector<FloatMotion> motions_;  // per part
  std::size_t turned_ = 0;            // of moved_.cut(), then of its parts, last first
  Tasks tasks_;
  Thresholds16 thresholds_;
  double cutoff_ = 0.0, motion_error_ = 0.0;  // that thresholds_ are for
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

/// Lists the tasks of a block against all that are shown, as TaskLister does.
template <Primitive P>
void BlockMoves<P>::face(std::uint32_t b, QueryCounts& counts) {
  const float more = thresholds_.margin();
  const FloatBox& own = blocks_.box(b);
  const typename Batch<P>::Grown lanes(blocks_.floats(b), more + blocks_.reach(b));
  const BoxLanes box(own.grown(more + blocks_.largest_reach()));
  const simd::Bits real = layout().blocks[b].real;
  const Near* near = near_list_.data() + near_start_[b];
  for (const std::uint32_t a : blocks_.sweep(own.grown(more), counts)) {
    const simd::Bits real_a = layout().blocks[a].real;
    const simd::Bits in_b = lanes.meets(blocks_.box(a)) & real;
    const simd::Bits in_a = Batch<P>::inside(blocks_.floats(a), box) & real_a;
    while (near->partner < a) ++near;
    if (near->partner == a) [[unlikely]] {
      // Rows belong to the later block.
      if (a < b)
        tasks_.add_rows(in_b, blocks_.position(b), blocks_.position(a), near->rows);
      else
        tasks_.add_rows(in_a, blocks_.position(a), blocks_.position(b), near->rows);
      continue;
    }
    const bool b_by_one = std::popcount(in_b) <= std::popcount(in_a);
    tasks_.add(b_by_one ? in_b : in_a, blocks_.position(b_by_one ? b : a), blocks_.position(b_by_one ? a : b),
               b_by_one ? real_a : real);
  }
}

template <Primitive P>
template <class Visit>
bool BlockMoves<P>::search(double cutoff, double motion_error, QueryCounts& counts, const Visit& visit) {
  const float extent = blocks_.extent();
  for (const auto& some : {moved_.whole(), moved_.cut()})
    for (const std::uint32_t b : some) blocks_.hide(b);
  motions_.resize(moved_.part_count());
  for (std::uint32_t part = 1; part < motions_.size(); ++part)
    motions_[part] = FloatMotion(frames_.transform(part), layout().origin, layout().scale);
  tasks_.clear();
  set_thresholds(cutoff, motion_error);
  bool wanted = true;
  const auto run = [&] {
    counts.pairs_tested += tasks_.size() * simd::width;
    run_tasks<P>(
        tasks_, blocks_, blocks_, Exactly<P>{}, thresholds_,
        [&](std::uint32_t one, std::uint32_t sixteen, simd::Bits bits, const simd::Float16&) {
          const std::uint32_t i = blocks_.primitive(one);
          for (; bits != 0 && wanted; bits &= bits - 1)
            wanted =
                visit(id<PrimitiveId>(i),
                      id<PrimitiveId>(blocks_.primitive(sixteen + static_cast<std::uint32_t>(std::countr_zero(bits)))));
          return wanted;
        });
    tasks_.clear();
  };
  const auto look = [&] {
    if (blocks_.extent() == extent_) return;
    wanted = holds();
    if (wanted) set_thresholds(cutoff, motion_error);
  };
  std::size_t patience = 1;
  const auto run_some = [&] {
    if (tasks_.size() < patience) return;
    patience = std::min(2 * patience, longest_run);
    run();
  };
  // What a joint cuts first: it is next to what stands still.
  for (std::size_t k = 0; wanted && k < moved_.cut().size(); ++k) {
    const std::uint32_t b = moved_.cut()[k];
    blocks_.turn(b, moved_.lane_parts(k), motions_);
    ++turned_;
    look();
    if (const simd::Bits lanes = near_->self_lanes(b); lanes != 0)
      tasks_.add_rows(lanes, blocks_.position(b), blocks_.position(b), near_->self_rows(b));
    face(b, counts);
    blocks_.show(b);
    blocks_.cover(b);
    run_some();
  }
  // Then what is farthest down the tree.
  for (std::uint32_t part = moved_.part_count(); wanted && part-- > 1;) {
    const std::span<const std::uint32_t> some = moved_.of_part(part);
    for (std::size_t k = some.size(); wanted && k-- > 0;) {
      blocks_.turn(some[k], motions_[part]);
      ++turned_;
      look();
      face(some[k], counts);
      run_some();
    }
    if (part == 1) break;  // nothing is left to meet them
    for (const std::uint32_t b : some) blocks_.show(b);
    cover(some);
  }
  if (wanted) run();
  if (holds()) return true;
  blocks_.restore_extent(extent);
  return false;
}

template <Primitive P>
void BlockMoves<P>::accept(const MovingParts& parts) {
  frames_.keep(parts);
  for (const auto& some : {moved_.whole(), moved_.cut()})
    for (const std::uint32_t b : some) {
      if (blocks_.is_worn(b)) blocks_.place(b, frames_.frames());
      blocks_.show(b);
    }
  cover_moved();
}

template <Primitive P>
void BlockMoves<P>::reject() noexcept {
  frames_.undo();
  const auto back = [&](std::uint32_t b) {
    if (turned_ > 0) {
      blocks_.turn_back(b);
      --turned_;
    }
    blocks_.show(b);
  };
  for (const std::uint32_t b : moved_.cut()) back(b);
  for (std::uint32_t part = moved_.part_count(); part-- > 1;) {
    const std::span<const std::uint32_t> some = moved_.of_part(part);
    for (std::size_t k = some.size(); k-- > 0;) back(some[k]);
  }
  cover_moved();
}

}  // namespace hinge
