// SPDX-License-Identifier: BSD-3-Clause
// Engines ask a custom filter for every pair, whatever its stock base filter promises.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "engine/own_filters.hpp"
#include "engine/random_mechanism.hpp"
#include "engine/side_by_side.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge {
namespace own_filter_test {

using test::OwnOfAll;
using test::OwnOfLinks;
using test::OwnOfList;
using test::OwnWithLinks;
using test::Random;

struct EveryOther : AdmitAll {
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept { return (index(i) + index(j)) % 2 == 0; }
};

/// Two parallel rows of 40 points where only opposite points are close. The filter admits every other pair.
TEST(OwnFilter, IsAskedOfPairsOutsideAllLists) {
  ModelBuilder<Point> builder;
  for (const double y : {0.0, 0.5}) {
    std::vector<Point> row;
    for (int k = 0; k < 40; ++k) row.push_back(Point{{2.0 * k, y, 0.0}});
    if (y > 0.0) row.erase(row.begin());  // opposite points then differ by the odd number 39 in their index
    builder.add_link(world, Revolute{}, row);
  }
  const Model<Point> model = builder.finish();
  const auto found = [&]<template <class, class, class> class EngineOf>() {
    Hierarchy<Point, EveryOther, UniformClearance, EngineOf> rows(model, EveryOther{}, UniformClearance{0.6});
    EXPECT_FALSE(rows.self_collides());
    EXPECT_EQ(rows.self_collisions().size(), 0U);
    return rows.self_within(3.0).size();
  };
  const std::size_t expected = found.template operator()<Brute>();
  EXPECT_GT(expected, 40U);
  EXPECT_EQ(found.template operator()<Simd>(), expected);
  EXPECT_EQ(found.template operator()<Lazy>(), expected);
}

/// Queries of one model and of two models in a few states. (Each kind of query is compiled per engine, which is
/// slow.)
template <class P, class F, template <class, class, class> class EngineOf>
void compare_own(std::uint64_t seeds = 25) {
  std::size_t hits = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Model<P> model = test::random_model(random, 10, random.one_in(2) ? 4 : 20, false, test::make_primitive<P>);
    const F filter = test::own_filter<F>(model, random);
    const UniformClearance clearance{IsPointLike<P> ? 1.0 : 0.3};
    Hierarchy<P, F, UniformClearance, EngineOf> tested(model, filter, clearance), other = tested;
    Hierarchy<P, F, UniformClearance, Brute> reference(model, filter, clearance), same = reference;
    std::vector<double> q(tested.dof_count());
    for (int state = 0; state < 3; ++state) {
      for (double& value : q) value = random.uniform(-3.0, 3.0);
      tested.update(q);
      reference.update(q);
      if (state == 1) {
        tested.calibrate_pair_order();
        tested.calibrate_pair_order(other, filter);
      }
      const std::vector<Hit> expected = reference.self_collisions(), across = reference.collisions(same, filter);
      hits += expected.size() + across.size();
      test::expect_same(tested.self_collisions(), expected);
      EXPECT_EQ(tested.self_collides(), !expected.empty());
      test::expect_same(tested.collisions(other, filter), across);
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(hits, seeds);
}

// Engines ask filters at the same points for every primitive; Simd has its own code for points and for triangles.
TEST(OwnFilter, DerivedFromAdmitAllIsAsked) {
  compare_own<Point, OwnOfAll, Simd>();
  compare_own<Triangle, OwnOfAll, Simd>();
  compare_own<Capsule, OwnOfAll, Lazy>();
}

// Engines treat filters with equal promises equally; own_filters.hpp states these promises.
TEST(OwnFilter, DerivedFromDifferentLinksIsAsked) {
  compare_own<Point, OwnOfLinks, Lazy>();
  compare_own<Triangle, OwnWithLinks, Simd>();
}
TEST(OwnFilter, DerivedFromAListIsAsked) {
  compare_own<Point, OwnOfList, Simd>();
  compare_own<Point, OwnOfList, Lazy>();
}

}  // namespace own_filter_test
}  // namespace hinge
