// SPDX-License-Identifier: BSD-3-Clause
// QueryCounts and QueryOptions: what a query reports about its work, and what it can be asked beyond its mode.
#pragma once

#include <cstdint>
#include <span>

namespace hinge {

/// Work done by queries; added to, never reset, by the queries it is handed to.
struct QueryCounts {
  std::uint64_t boxes_tested = 0;  ///< pairs of boxes compared
  std::uint64_t nodes_split = 0;   ///< hierarchy nodes built during the queries
  std::uint64_t pairs_tested = 0;  ///< pairs of primitives whose distance was looked at
};

struct QueryOptions {
  /// Only pairs whose distance may have changed in the last update.
  bool moved_only = false;
  /// Extra clearance per rigid group (model length unit, finite, >= 0), added to the threshold of every pair for both
  /// of its groups. Empty: none.
  std::span<const double> clearance{};
  /// The same for the groups of the other model, in queries between two.
  std::span<const double> other_clearance{};
  QueryCounts* counts = nullptr;

  bool adds_clearance() const noexcept { return !clearance.empty() || !other_clearance.empty(); }
};

}  // namespace hinge
