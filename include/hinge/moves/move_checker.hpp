// SPDX-License-Identifier: BSD-3-Clause
// MoveChecker: tries Monte Carlo moves of a few DOF, each with the verdict of a full query, and accepts or rejects
// them.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/detail/moves/asked_hierarchy.hpp"
#include "hinge/detail/moves/block_moves.hpp"
#include "hinge/detail/moves/known_pairs.hpp"
#include "hinge/detail/moves/move_cut.hpp"
#include "hinge/detail/moves/placing_bounds.hpp"
#include "hinge/detail/primitive/batch.hpp"
#include "hinge/detail/primitive/triangle_leaf.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/moves/dof_change.hpp"
#include "hinge/moves/move_counts.hpp"

namespace hinge {

/// Holds a state and at most one pending move. Verdicts, pairs and frames equal those of a Hierarchy updated to the
/// configuration after the move, bit for bit: errors do not accumulate. One per thread. See docs/explanation/moves.md.
template <Primitive P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf = Simd>
class MoveChecker {
 public:
  /// Starts at the reference: every value is 0. The state of `hierarchy` does not matter.
  explicit MoveChecker(Hierarchy<P, F, D, EngineOf> hierarchy)
      : hierarchy_(std::move(hierarchy)),
        cut_(*model().groups(), hierarchy_.get().dof_count()),
        rounding_(model()),
        q_(hierarchy_.get().dof_count(), 0.0) {
    if constexpr (by_blocks) blocks_.emplace(model(), hierarchy_.get().filter(), matrix(), parts());
    set(std::vector<double>(q_));
  }

  /// Sets the state to q (dof_count() values, rad or model length unit), which may collide, and drops the pending move.
  /// Throws ConfigurationError as Hierarchy::update does; nothing changes then.
  void set(std::span<const double> q);

  /// Returns true if the changed state is free. The move is pending until accept(), reject() or the next try. Throws
  /// ConfigurationError for an unknown or repeated DOF, a value that is not finite, or a slide above 2^1000; nothing
  /// changes then.
  bool try_move(std::span<const DofChange> changes) { return !attempt(changes, false); }
  /// Tries a move and returns all pairs that collide after it, sorted by (first, second). Valid until the next call.
  const std::vector<Hit>& try_move_listed(std::span<const DofChange> changes) {
    attempt(changes, true);
    return list_collisions(tried_known_, hits_);
  }
  /// The pending move becomes the state, even if it collides. Throws ConfigurationError if no move is pending.
  void accept();
  /// Drops the pending move, if any.
  void reject() noexcept {
    if constexpr (by_blocks)
      if (pending_ == Pending::blocks) blocks_->reject();
    pending_ = Pending::none;
    hierarchy_.rejected();
  }

  // The functions below describe the state without the pending move.
  /// dof_count() values, rad or model length unit. Valid until the state changes.
  std::span<const double> configuration() const noexcept { return q_; }
  /// Returns true if the state has a colliding pair.
  bool collides() const noexcept { return any_collides(known_); }
  /// All colliding pairs, sorted by (first, second). Valid until the next call.
  const std::vector<Hit>& collisions() { return list_collisions(known_, hits_); }
  /// World frame of a rigid group. Valid until the next call.
  const Frame& frame(GroupId group);
  /// World coordinates of a primitive.
  P placed(PrimitiveId i) { return place(i, frame(model().group_of(i))); }

  const SelectedModel<P>& model() const noexcept { return hierarchy_.get().model(); }  ///< shared
  std::size_t dof_count() const noexcept { return q_.size(); }                         ///< length of configuration()
  /// Work done by all moves so far.
  const MoveCounts& counts() const noexcept { return counts_; }

 private:
  // Primitives that engines keep in static trees, or whose blocks do not turn, are answered by moved-only queries.
  static constexpr bool by_blocks = detail::TransformsBatch<P> && !detail::UsesStaticBvh<P>;
  // With fewer blocks per changed joint, most blocks are cut by a joint, and the full query is faster. The share of
  // moving blocks does not matter (bench/moves.cpp).
  static constexpr std::size_t least_blocks_per_joint = 4;

  enum class Pending : std::uint8_t { none, blocks, query };

  bool attempt(std::span<const DofChange> changes, bool all);

  const D& matrix() const noexcept { return hierarchy_.get().matrix(); }
  const detail::MovingParts& parts() const noexcept { return cut_.parts(); }
  std::uint32_t part_of(PrimitiveId i) const noexcept { return parts().part_of(model().group_of(i)); }
  P place(PrimitiveId i, const Frame& frame) const noexcept {
    const P& local = model().primitives()[index(i)];
    return model().group_of(i) == GroupId{0} ? local : local.placed(frame.pose());
  }
  /// The primitive after the pending move.
  P tried(PrimitiveId i) {
    if constexpr (by_blocks)
      if (pending_ == Pending::blocks)
        return place(i, blocks_->frames().tried(parts().place(model().group_of(i)), parts()));
    return hierarchy_.placed(i);
  }
  /// Finds the known pairs of the state: those with d - M within the rounding tolerance.
  void collect() {
    hierarchy_.go_to_state(q_);
    known_.clear();
    hierarchy_.ask(rounding_.tolerance(), false, true, known_, nullptr);
  }

  /// Updates blocks_ to the state.
  void catch_up() {
    if constexpr (by_blocks) {
      if (all_behind_) {
        blocks_->set(q_, parts());
      } else if (!behind_.empty()) {
        // Keep each DOF once, with its present value.
        std::sort(behind_.begin(), behind_.end(), DofChange::by_dof);
        const auto same = [](const DofChange& a, const DofChange& b) { return a.dof == b.dof; };
        behind_.erase(std::unique(behind_.begin(), behind_.end(), same), behind_.end());
        for (DofChange& change : behind_) change.value = q_[change.dof];
        cut_.cut(behind_);
        blocks_->jump(cut_.values(), parts());
      }
      behind_.clear();
      all_behind_ = false;
    }
  }

  /// Tests the known pairs inside one moving part again: only rounding changes their distance. Returns true if one
  /// collides.
  bool recheck(bool all) {
    complete_ = true;
    bool collides = false;
    for (const detail::KnownPair& pair : known_) {
      const PrimitiveId i = pair.hit.first, j = pair.hit.second;
      const std::uint32_t part = part_of(i);
      if (part != part_of(j)) continue;
      if (part == 0) {
        tried_known_.push_back(pair);
        collides = collides || pair.collides;
      } else if (judge(i, j, tried(i), tried(j), matrix(), rounding_.tolerance(), tried_known_)) {
        collides = true;
      }
      complete_ = all || !collides;
      if (!complete_) return true;
    }
    return collides;
  }

  /// Stores one collision. The list of pairs is then incomplete; returns false.
  bool note_collision(PrimitiveId i, PrimitiveId j) {
    tried_known_.push_back({{i, j, 0.0, matrix().threshold(i, j)}, true});
    return complete_ = false;
  }

  /// Tests a pair that floats could not rule out. Returns false to stop the search.
  bool find_near(PrimitiveId i, PrimitiveId j, bool all) {
    if constexpr (by_blocks) {
      const std::uint32_t a = part_of(i), b = part_of(j);
      if (a == b || model().constant(i, j)) return true;
      // Place both by the parts' motions in double, without forward kinematics: nearly always enough for a verdict.
      const P p = place(i, blocks_->frames().moved(parts().place(model().group_of(i)), a));
      const P q = place(j, blocks_->frames().moved(parts().place(model().group_of(j)), b));
      const double m = matrix().threshold(i, j), off = rounding_.pair_error(m);
      if (!closer_than(p, q, m + (off + rounding_.tolerance())) || !hierarchy_.get().filter().admits(i, j)) return true;
      if (!all && m > off && closer_than(p, q, m - off)) return note_collision(i, j);
      const bool collides = judge(i, j, tried(i), tried(j), matrix(), rounding_.tolerance(), tried_known_);
      return complete_ = all || !collides;
    }
    return false;
  }

  /// Answers by blocks, in tried_known_. Returns false if the full query must answer.
  bool try_blocks(bool all) {
    if constexpr (by_blocks) {
      if (!rounding_.is_small() || least_blocks_per_joint * changes_.size() > blocks_->block_count() ||
          changes_.size() > detail::MoveFrames::most_kept)
        return false;
      catch_up();
      if (!blocks_->holds()) return false;
      cut_.cut(changes_);
      counts_.blocks_moved += blocks_->begin(cut_.values(), parts());
      pending_ = Pending::blocks;
      if (recheck(all) && !all) return true;
      const double tolerance = rounding_.tolerance(), error = rounding_.motion_error();
      if constexpr (detail::ComparesTwo<P>) {
        const auto note = [&](PrimitiveId i, PrimitiveId j) { note_collision(i, j); };
        if (!all && blocks_->recall(parts(), tolerance, error, counts_, note)) return true;
      }
      const auto visit = [&](PrimitiveId i, PrimitiveId j) { return find_near(std::min(i, j), std::max(i, j), all); };
      if (blocks_->search(parts(), matrix(), tolerance, error, counts_.query, visit)) return true;
      reject();
    }
    return false;
  }

  detail::AskedHierarchy<Hierarchy<P, F, D, EngineOf>> hierarchy_;
  detail::MoveCut cut_;
  detail::MoveRounding rounding_;
  std::vector<double> q_;
  std::vector<detail::KnownPair> known_, tried_known_;
  std::vector<Hit> hits_;
  std::vector<DofChange> changes_;  // changes of the pending move that change a value
  Pending pending_ = Pending::none;
  bool complete_ = false;  // true if tried_known_ holds all pairs
  std::optional<std::conditional_t<by_blocks, detail::BlockMoves<P>, std::monostate>> blocks_;
  std::vector<DofChange> behind_;  // accepted, but not yet applied to blocks_
  bool all_behind_ = true;
  MoveCounts counts_;
};

template <Primitive P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
void MoveChecker<P, F, D, EngineOf>::set(std::span<const double> q) {
  hierarchy_.set(q);
  reject();
  std::copy(q.begin(), q.end(), q_.begin());
  double slide = 0.0;
  for (std::size_t k = 0; k < q_.size(); ++k)
    if (cut_.is_slide(k)) slide = std::max(slide, std::abs(q_[k]));
  all_behind_ = true;
  rounding_.set_slides(model(), slide);
  collect();
}

template <Primitive P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
bool MoveChecker<P, F, D, EngineOf>::attempt(std::span<const DofChange> changes, bool all) {
  cut_.check(changes);
  reject();
  ++counts_.tried;
  changes_.clear();
  tried_known_.clear();
  double slide = 0.0;
  for (const DofChange& change : changes) {
    if (std::bit_cast<std::uint64_t>(change.value) == std::bit_cast<std::uint64_t>(q_[change.dof])) continue;
    changes_.push_back(change);
    if (cut_.is_slide(change.dof)) slide = std::max(slide, std::abs(change.value));
  }
  if (slide > rounding_.longest_slide()) {
    rounding_.set_slides(model(), slide);
    collect();
  }
  if (try_blocks(all)) return any_collides(tried_known_);
  tried_known_.clear();
  pending_ = Pending::query;
  const double tolerance = rounding_.tolerance();
  if (by_blocks || !rounding_.is_small()) {
    ++counts_.full_queries;
    hierarchy_.go_to_move(q_, changes_);
    complete_ = hierarchy_.ask(tolerance, false, all, tried_known_, nullptr);
  } else {
    hierarchy_.go_to_state(q_);
    hierarchy_.go_to_move(q_, changes_);
    cut_.cut(changes_);
    if (!recheck(all) || all) complete_ = hierarchy_.ask(tolerance, true, all, tried_known_, &counts_.query);
  }
  return any_collides(tried_known_);
}

template <Primitive P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
void MoveChecker<P, F, D, EngineOf>::accept() {
  if (pending_ == Pending::none) throw ConfigurationError("there is no pending move to accept");
  if (!complete_) return set(hierarchy_.after(q_, changes_));  // not all of its collisions are known
  for (const DofChange& change : changes_) q_[change.dof] = change.value;
  known_.swap(tried_known_);
  if constexpr (by_blocks) {
    if (pending_ == Pending::blocks) {
      blocks_->accept(parts());
    } else {
      behind_.insert(behind_.end(), changes_.begin(), changes_.end());
      all_behind_ = all_behind_ || behind_.size() > q_.size();
      if (all_behind_) behind_.clear();
    }
  }
  pending_ = Pending::none;
  hierarchy_.accepted();
}

template <Primitive P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
const Frame& MoveChecker<P, F, D, EngineOf>::frame(GroupId group) {
  if constexpr (by_blocks) {
    catch_up();  // a pending move by blocks has already caught up, and its cut is kept
    blocks_->frames().settle(parts());
    return blocks_->frames().frame(parts().place(group));
  }
  hierarchy_.go_to_state(q_);
  return hierarchy_.frames()[index(group)];
}

}  // namespace hinge
