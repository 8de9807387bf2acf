// SPDX-License-Identifier: BSD-3-Clause
// QueryCounts, GroupRange and QueryOptions: the work counters of queries and their optional settings.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "hinge/core/id.hpp"

namespace hinge {

/// Work counters. Each query adds to them and never resets them.
struct QueryCounts {
  std::uint64_t boxes_tested = 0;  ///< tests of one box against another
  std::uint64_t nodes_split = 0;   ///< hierarchy nodes built during queries
  std::uint64_t pairs_tested = 0;  ///< pairs of primitives with a computed distance or distance bound
};

/// Rigid groups first, ..., end - 1.
struct GroupRange {
  GroupId first{0};                                        ///< first group
  GroupId end{std::numeric_limits<std::uint32_t>::max()};  ///< group past the last one

  /// Returns true when the range holds all groups.
  bool is_all() const noexcept { return *this == GroupRange{}; }
  /// Returns true when the larger of two groups is in the range.
  bool holds_larger(GroupId g, GroupId h) const noexcept {
    const GroupId larger = g < h ? h : g;
    return first <= larger && larger < end;
  }
  /// Returns true if both ends are equal.
  friend bool operator==(const GroupRange&, const GroupRange&) = default;
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
  /// In queries of one model: reports only pairs whose rigid group of the larger index is in this range. The pose of a
  /// group depends only on its own value and on those of groups with smaller indices. So a chain can be tested while
  /// its values are being chosen: the ranges [0, a), [a, b), ... together report every pair once.
  GroupRange groups{};

  /// Returns true when either clearance list is given.
  bool adds_clearance() const noexcept { return !clearance.empty() || !other_clearance.empty(); }
};

}  // namespace hinge
