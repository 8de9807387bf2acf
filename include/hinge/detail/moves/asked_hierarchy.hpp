// SPDX-License-Identifier: BSD-3-Clause
// AskedHierarchy: a hierarchy that follows a state and a tried move, and lists known pairs.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/moves/known_pairs.hpp"
#include "hinge/detail/moves/move_cut.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// H: a Hierarchy. It remembers which configuration the hierarchy holds, and updates it only when needed.
template <class H>
class AskedHierarchy {
 public:
  explicit AskedHierarchy(H hierarchy) : hierarchy_(std::move(hierarchy)) {}

  const H& get() const noexcept { return hierarchy_; }

  /// Goes to another state. Throws ConfigurationError as Hierarchy::update does; nothing changes then.
  void set(std::span<const double> q) {
    hierarchy_.update(q);
    held_ = Held::state;
  }
  /// Goes to the state q unless the hierarchy is there.
  void go_to_state(std::span<const double> q) {
    if (held_ != Held::state) set(q);
  }
  /// Goes to the configuration after a move from the state q.
  void go_to_move(std::span<const double> q, std::span<const DofChange> changes) {
    hierarchy_.update(after(q, changes));
    held_ = Held::tried;
  }
  /// Returns the configuration after a move from q. Valid until the next call.
  const std::vector<double>& after(std::span<const double> q, std::span<const DofChange> changes) {
    next_.assign(q.begin(), q.end());
    for (const DofChange& change : changes) next_[change.dof] = change.value;
    return next_;
  }
  /// Tells whether the pending move became the state or was dropped.
  void accepted() noexcept { held_ = held_ == Held::tried ? Held::state : Held::other; }
  void rejected() noexcept {
    if (held_ == Held::tried) held_ = Held::other;
  }

  /// Adds the pairs with d - M < tolerance to `known`. Returns false if it stopped at the first collision (only when
  /// `all` is false). moved_only: only pairs that moved since the previous update.
  bool ask(double tolerance, bool moved_only, bool all, std::vector<KnownPair>& known, QueryCounts* counts) {
    const auto place = [&](PrimitiveId i) { return hierarchy_.placed(i); };
    NearPairs near(hierarchy_.matrix(), tolerance, all, place, known);
    QueryOptions options;
    options.moved_only = moved_only;
    options.counts = counts;
    hierarchy_.self_query(near, options);
    return !near.done();
  }

  auto placed(PrimitiveId i) noexcept { return hierarchy_.placed(i); }
  auto frames() noexcept { return hierarchy_.frames(); }

 private:
  enum class Held : std::uint8_t { other, state, tried };

  H hierarchy_;
  Held held_ = Held::other;
  std::vector<double> next_;
};

}  // namespace hinge::detail
