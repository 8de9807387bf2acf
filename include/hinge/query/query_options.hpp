// SPDX-License-Identifier: BSD-3-Clause
// QueryCounts, Precision and QueryOptions: the work counters of queries and their optional settings.
#pragma once

#include <cstdint>
#include <span>

namespace hinge {

/// Work counters. Each query adds to them and never resets them.
struct QueryCounts {
  std::uint64_t boxes_tested = 0;  ///< tests of one box against another
  std::uint64_t nodes_split = 0;   ///< hierarchy nodes built during queries
  std::uint64_t pairs_tested = 0;  ///< pairs of primitives with a computed distance or distance bound
  std::uint64_t undecided = 0;     ///< admitted pairs too close to the limit for floats; Precision decided them
};

/// How a query decides a pair. exact: correct for the real numbers that the stored coordinates and thresholds
/// represent. The other two use float distances where they are available: for points, in engine/simd, in queries that
/// do not rank. A pair is undecided when floats cannot separate its d - M from the limit. never_miss counts it as a
/// hit, never_cry_wolf does not. docs/explanation/numerics.md gives the width of this band; the error of the reported
/// float distances is below it. All other queries are exact and leave no pair undecided.
enum class Precision : std::uint8_t { exact, never_miss, never_cry_wolf };

/// Optional settings of a query.
struct QueryOptions {
  /// Reports only pairs whose distance may have changed in the last update.
  bool moved_only = false;
  /// Extra clearance per rigid group (model length unit, finite, >= 0). A pair's threshold grows by the clearances of
  /// both its groups. An empty span means none. The caller keeps the memory alive during the query.
  std::span<const double> clearance{};
  /// The same for the groups of the other model, in queries between two models.
  std::span<const double> other_clearance{};
  /// Counters to add to, or null. Not owned.
  QueryCounts* counts = nullptr;
  /// See Precision.
  Precision precision = Precision::exact;

  /// Returns true when either clearance list is given.
  bool adds_clearance() const noexcept { return !clearance.empty() || !other_clearance.empty(); }
};

}  // namespace hinge
