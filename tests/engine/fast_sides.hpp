// SPDX-License-Identifier: BSD-3-Clause
// Checks float queries against the exact answer: each may err to one side only, and by the undecided pairs only.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "hinge/policy/collector.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::test {

/// Whether `hits` contains all pairs of `wanted`; both lists are sorted.
inline bool names_all(const std::vector<Hit>& hits, const std::vector<Hit>& wanted) {
  return std::includes(hits.begin(), hits.end(), wanted.begin(), wanted.end(), [](const Hit& x, const Hit& y) {
    return std::tie(x.first, x.second) < std::tie(y.first, y.second);
  });
}

/// Runs one query in both float precisions. `list` and `any` run it with the options that they receive; `exact` is
/// its exact answer. Returns the number of undecided pairs.
template <class List, class Any>
std::uint64_t expect_on_their_sides(QueryOptions options, const std::vector<Hit>& exact, const List& list,
                                    const Any& any) {
  QueryCounts missing, crying;
  options.precision = Precision::never_miss;
  options.counts = &missing;
  const std::vector<Hit> more = list(options);
  options.precision = Precision::never_cry_wolf;
  options.counts = &crying;
  const std::vector<Hit> less = list(options);
  EXPECT_TRUE(names_all(more, exact));
  EXPECT_TRUE(names_all(exact, less));
  EXPECT_EQ(more.size() - less.size(), missing.undecided);
  EXPECT_EQ(missing.undecided, crying.undecided);
  for (const Precision side : {Precision::never_miss, Precision::never_cry_wolf}) {
    QueryCounts counts;
    options.precision = side;
    options.counts = &counts;
    const bool hit = any(options);
    if (hit == exact.empty()) {
      EXPECT_EQ(hit, side == Precision::never_miss);
      EXPECT_GT(counts.undecided, 0U);
    }
  }
  return missing.undecided;
}

}  // namespace hinge::test
