// SPDX-License-Identifier: BSD-3-Clause
// QueryCounts and QueryOptions: the work counters of queries and their optional settings.
#pragma once

#include <cstdint>
#include <span>

namespace hinge {

/// Work counters. Each query adds to them and never resets them.
struct QueryCounts {
  std::uint64_t boxes_tested = 0;  ///< tests of one box against another
  std::uint64_t nodes_split = 0;   ///< hierarchy nodes built during queries
  std::uint64_t pairs_tested = 0;  ///< pairs of primitives with a computed distance or distance bound
};

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

  /// Returns true when either clearance list is given.
  bool adds_clearance() const noexcept { return !clearance.empty() || !other_clearance.empty(); }
};

}  // namespace hinge
