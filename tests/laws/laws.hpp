// SPDX-License-Identifier: BSD-3-Clause
// What the concepts demand beyond syntax, as checks for any policy: hand them your own samples inside a GoogleTest
// TEST,
//   hinge::laws::check_primitive(samples, poses);
// Lengths compare to within `rounding` times the largest coordinate involved.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::laws {

/// Room for a few dozen roundings of coordinates; a wrong formula is off by much more.
inline constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

inline double magnitude(const Aabb& box) {
  double largest = 0.0;
  for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(box.lower[k]), std::abs(box.upper[k])});
  return largest;
}

/// Symmetric, >= 0, 0 to itself, not below the gap of the bounds, the same under a common pose; closer_than follows the
/// distance and grows with m; closest points realise the distance.
template <Primitive P>
void check_primitive(std::span<const P> samples, std::span<const Pose> poses) {
  for (const P& p : samples) {
    EXPECT_EQ(squared_distance(p, p), 0.0);
    const Aabb same = p.placed(Pose{}).bounds();
    EXPECT_TRUE(same.contains(p.bounds()) && p.bounds().contains(same));
  }
  for (const P& p : samples)
    for (const P& q : samples) {
      const double d = std::sqrt(squared_distance(p, q));
      const double tolerance = rounding * (magnitude(p.bounds()) + magnitude(q.bounds()));
      EXPECT_GE(d, 0.0);
      EXPECT_NEAR(d, std::sqrt(squared_distance(q, p)), tolerance);
      EXPECT_GE(d, separation(p.bounds(), q.bounds()) - tolerance);
      EXPECT_TRUE(closer_than(p, q, d + tolerance + 1e-3 * d));
      if (d > tolerance) {
        EXPECT_FALSE(closer_than(p, q, d - std::min(d, tolerance + 1e-3 * d)));
      }
      EXPECT_EQ(closer_than(p, q, d), closer_than(q, p, d)) << "an exact tie has one answer";
      for (const Pose& pose : poses) {
        const P a = p.placed(pose), b = q.placed(pose);
        const double moved = rounding * (magnitude(a.bounds()) + magnitude(b.bounds())) + tolerance;
        EXPECT_NEAR(std::sqrt(squared_distance(a, b)), d, moved);
      }
      if constexpr (HasClosestPoints<P>) {
        const auto [x, y] = closest_points(p, q);
        EXPECT_NEAR(std::sqrt(squared_norm(Vec3(x - y))), d, tolerance);
        EXPECT_LE(separation(Aabb(x), p.bounds()), tolerance);
        EXPECT_LE(separation(Aabb(y), q.bounds()), tolerance);
      }
    }
}

/// Symmetric, repeatable; lists of exclusions (and the scope) sorted, symmetric and in agreement with admits. For n
/// primitives.
template <PairFilter F>
void check_pair_filter(const F& filter, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j) continue;
      const auto a = id<PrimitiveId>(i), b = id<PrimitiveId>(j);
      EXPECT_EQ(filter.admits(a, b), filter.admits(b, a)) << i << " " << j;
      if constexpr (ListsExclusions<F>) {
        const std::span<const PrimitiveId> list = filter.excluded(a);
        EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
        bool admitted = std::find(list.begin(), list.end(), b) == list.end();
        if constexpr (ScopesPairs<F>) admitted = admitted && filter.in_scope(a, b);
        EXPECT_EQ(filter.admits(a, b), admitted) << i << " " << j;
        EXPECT_EQ(std::find(list.begin(), list.end(), a), list.end());
      }
    }
}

/// Symmetric, finite, >= 0; reaches cover thresholds. For n primitives.
template <DistanceMatrix D>
void check_distance_matrix(const D& matrix, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const auto a = id<PrimitiveId>(i), b = id<PrimitiveId>(j);
      const double m = matrix.threshold(a, b);
      EXPECT_TRUE(is_finite(m) && m >= 0.0);
      EXPECT_EQ(m, matrix.threshold(b, a));
      EXPECT_GE(matrix.reach(a) + matrix.reach(b), m);
    }
}

/// The cutoff never grows and a collector that is done stays done, whatever hits come.
template <Collector C>
void check_collector(C collector, std::span<const Hit> hits) {
  double cutoff = collector.cutoff();
  bool done = collector.done();
  for (const Hit& hit : hits) {
    collector.add(hit);
    EXPECT_LE(collector.cutoff(), cutoff);
    EXPECT_TRUE(!done || collector.done());
    cutoff = collector.cutoff();
    done = collector.done();
  }
}

}  // namespace hinge::laws
