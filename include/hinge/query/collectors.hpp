// SPDX-License-Identifier: BSD-3-Clause
// The four query modes as collectors: any, all, within a margin, closest.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "hinge/detail/query/sort_hits.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge {

/// Yes or no; stops at the first hit, which may be any of them.
class AnyHit {
 public:
  static constexpr bool ranks = false;
  static constexpr bool stops_at_first = true;
  void add(const Hit& hit) noexcept { hit_ = hit; }
  double cutoff() const noexcept { return 0.0; }
  bool done() const noexcept { return hit_.has_value(); }
  const std::optional<Hit>& hit() const noexcept { return hit_; }

 private:
  std::optional<Hit> hit_;
};

/// Every pair with d - M below a margin >= 0; margin 0 gives the colliding pairs.
class HitsWithin {
 public:
  static constexpr bool ranks = false;
  explicit HitsWithin(double margin = 0.0) noexcept : margin_(margin) {}
  void add(const Hit& hit) { hits_.push_back(hit); }
  double cutoff() const noexcept { return margin_; }
  bool done() const noexcept { return false; }

  /// The pairs, sorted by (first, second).
  std::vector<Hit> take() {
    detail::sort_hits(hits_);
    return std::exchange(hits_, {});
  }

 private:
  double margin_;
  std::vector<Hit> hits_;
};

/// The pair with the smallest d - M: the closest one, the most interpenetrating one when any collides. Among the exact
/// ties that an engine meets, the smallest (first, second).
class Closest {
 public:
  static constexpr bool ranks = true;
  static constexpr bool keeps_smallest = true;
  Closest() = default;
  /// least: no pair has a smaller d - M; the first that is not above it ends the search.
  explicit Closest(double least) noexcept : least_(least) {}
  void add(const Hit& hit) noexcept {
    const auto key = [](const Hit& h) { return std::tuple(h.gap(), h.first, h.second); };
    if (hit_ && !(key(hit) < key(*hit_))) return;
    hit_ = hit;
    done_ = hit.gap() <= least_;
  }
  double cutoff() const noexcept { return hit_ ? hit_->gap() : std::numeric_limits<double>::infinity(); }
  bool done() const noexcept { return done_; }
  const std::optional<Hit>& hit() const noexcept { return hit_; }

 private:
  double least_ = -std::numeric_limits<double>::infinity();
  bool done_ = false;
  std::optional<Hit> hit_;
};

static_assert(Collector<AnyHit> && Collector<HitsWithin> && Collector<Closest>);

}  // namespace hinge
