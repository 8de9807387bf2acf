// SPDX-License-Identifier: BSD-3-Clause
// The query modes as collectors: any hit, all hits within a margin, the closest pair.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

#include "hinge/detail/query/sort_hits.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge {

/// Collector of yes/no queries: it stops at the first hit, which is an arbitrary colliding pair.
class AnyHit {
 public:
  static constexpr bool ranks = false;          ///< add() receives hits only
  static constexpr bool stops_at_first = true;  ///< any hit is a valid answer
  /// Stores the hit.
  void add(const Hit& hit) noexcept { hit_ = hit; }
  /// Returns 0: only collisions count.
  double cutoff() const noexcept { return 0.0; }
  /// Returns true when there is a hit.
  bool done() const noexcept { return hit_.has_value(); }
  /// Returns the hit, or nullopt when nothing collides.
  const std::optional<Hit>& hit() const noexcept { return hit_; }

 private:
  std::optional<Hit> hit_;
};

/// Collects every pair with d - M < margin. With margin 0 these are the colliding pairs.
class HitsWithin {
 public:
  static constexpr bool ranks = false;  ///< add() receives hits only
  /// margin: >= 0, model length unit.
  explicit HitsWithin(double margin = 0.0) noexcept : margin_(margin) {}
  /// Empties the collector for another query, and keeps its memory.
  void start(double margin) noexcept {
    margin_ = margin;
    hits_.clear();
  }
  /// Appends the hit.
  void add(const Hit& hit) { hits_.push_back(hit); }
  /// Returns the margin.
  double cutoff() const noexcept { return margin_; }
  /// Returns false: all hits are needed.
  bool done() const noexcept { return false; }

  /// Returns the hits, sorted by (first, second), and empties the collector, which keeps its memory.
  std::vector<Hit> take() {
    std::vector<Hit> sorted = detail::sorted_hits(hits_);
    hits_.clear();
    return sorted;
  }

 private:
  double margin_;
  std::vector<Hit> hits_;
};

/// Keeps the pair with the smallest d - M: the closest pair, or the deepest collision. Among exact ties that the engine
/// reports, it keeps the smallest (first, second).
class Closest {
 public:
  static constexpr bool ranks = true;           ///< add() receives every pair that boxes do not rule out
  static constexpr bool keeps_smallest = true;  ///< bounds of one pair may rule out others
  /// No known lower bound: the search ends when no pair is left.
  Closest() = default;
  /// least: lower bound of d - M over all pairs (model length unit). A pair at or below it ends the search.
  explicit Closest(double least) noexcept : least_(least) {}
  /// Keeps the hit when it precedes the current best.
  void add(const Hit& hit) noexcept {
    const auto key = [](const Hit& h) { return std::tuple(h.gap(), h.first, h.second); };
    if (hit_ && !(key(hit) < key(*hit_))) return;
    hit_ = hit;
    done_ = hit.gap() <= least_;
  }
  /// Returns the smallest d - M so far, or infinity.
  double cutoff() const noexcept { return hit_ ? hit_->gap() : std::numeric_limits<double>::infinity(); }
  /// Returns true when the best pair has reached the lower bound.
  bool done() const noexcept { return done_; }
  /// Returns the best pair, or nullopt when no pair was tested.
  const std::optional<Hit>& hit() const noexcept { return hit_; }

 private:
  double least_ = -std::numeric_limits<double>::infinity();
  bool done_ = false;
  std::optional<Hit> hit_;
};

static_assert(Collector<AnyHit> && Collector<HitsWithin> && Collector<Closest>);

}  // namespace hinge
