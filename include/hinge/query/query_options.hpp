// SPDX-License-Identifier: BSD-3-Clause
// QueryCounts, Precision and QueryOptions: what a query reports about its work, and what it can be asked beyond its
// mode.
#pragma once

#include <cstdint>
#include <span>

namespace hinge {

/// Work done by queries; added to, never reset, by the queries it is handed to.
struct QueryCounts {
  std::uint64_t boxes_tested = 0;  ///< pairs of boxes compared
  std::uint64_t nodes_split = 0;   ///< hierarchy nodes built during the queries
  std::uint64_t pairs_tested = 0;  ///< pairs of primitives whose distance was looked at
  std::uint64_t undecided = 0;     ///< admitted pairs that floats left open and the query's Precision decided
};

/// How a verdict is reached. Exact: that of the real numbers that coordinates and thresholds are. The fast ones decide
/// by floats alone wherever those measure a distance: in engine/simd, of points, in queries that do not rank. A pair
/// whose d - M they cannot tell from the limit is undecided: it counts as a hit in order never to miss one, or as none
/// in order never to cry wolf. docs/explanation/numerics.md has the width of that band. Hits carry float distances,
/// which are off by less than it. All other queries are answered exactly, and leave nothing undecided.
enum class Precision : std::uint8_t { exact, never_miss, never_cry_wolf };

struct QueryOptions {
  /// Only pairs whose distance may have changed in the last update.
  bool moved_only = false;
  /// Extra clearance per rigid group (model length unit, finite, >= 0), added to the threshold of every pair for both
  /// of its groups. Empty: none.
  std::span<const double> clearance{};
  /// The same for the groups of the other model, in queries between two.
  std::span<const double> other_clearance{};
  QueryCounts* counts = nullptr;
  Precision precision = Precision::exact;

  bool adds_clearance() const noexcept { return !clearance.empty() || !other_clearance.empty(); }
};

}  // namespace hinge
