// SPDX-License-Identifier: BSD-3-Clause
// AskedHierarchy: a hierarchy that is at the state, at a move away from it, or elsewhere, and is asked for known pairs.
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

/// H: a Hierarchy.
template <class H>
class AskedHierarchy {
 public:
  explicit AskedHierarchy(H hierarchy) : hierarchy_(std::move(hierarchy)) {}

  const H& get() const noexcept { return hierarchy_; }

  /// To another state. ConfigurationError: see Hierarchy::update; nothing changes.
  void set(std::span<const double> q) {
    hierarchy_.update(q);
    held_ = Held::state;
  }
  void go_to_state(std::span<const double> q) {
    if (held_ != Held::state) set(q);
  }
  /// q is the state.
  void go_to_move(std::span<const double> q, std::span<const DofChange> changes) {
    hierarchy_.update(after(q, changes));
    held_ = Held::tried;
  }
  /// The configuration after a move; valid until the next call.
  const std::vector<double>& after(std::span<const double> q, std::span<const DofChange> changes) {
    next_.assign(q.begin(), q.end());
    for (const DofChange& change : changes) next_[change.dof] = change.value;
    return next_;
  }
  /// The pending move became the state, or was dropped.
  void accepted() noexcept { held_ = held_ == Held::tried ? Held::state : Held::other; }
  void rejected() noexcept {
    if (held_ == Held::tried) held_ = Held::other;
  }

  /// Adds the pairs with d - M < tolerance; false when it stopped at the first collision, not all being asked for.
  /// moved_only: of those that moved since the update before.
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
