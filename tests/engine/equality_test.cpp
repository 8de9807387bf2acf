// SPDX-License-Identifier: BSD-3-Clause
// Every query on every engine equals brute force, and brute force equals a plain double loop written here.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "engine/side_by_side.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge {
namespace equality_test {

using test::compare_with_brute;
using test::ExcludedPairs;
using test::make_primitive;
using test::Random;

template <class P>
class EngineEquality : public testing::Test {};
TYPED_TEST_SUITE(EngineEquality, test::Primitives);

TYPED_TEST(EngineEquality, LazyEqualsBruteOnRandomMechanisms) {
  using P = TypeParam;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto model = test::random_model(random, 12, 5, random.one_in(2), make_primitive<P>);
    ExcludedPairs filter(model.size(), random, 5);
    if (random.one_in(2)) filter.list_nothing();
    compare_with_brute<P, ExcludedPairs, Lazy>(random, filter, model);
    if (testing::Test::HasFailure()) return;
  }
}

TYPED_TEST(EngineEquality, BruteEqualsTheFormula) {
  using P = TypeParam;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto model = test::random_model(random, 8, 6, false, make_primitive<P>);
    const ExcludedPairs filter(model.size(), random, 5);
    const auto matrix = test::random_thresholds(model.size(), random);
    Hierarchy<P, ExcludedPairs, TypedThresholds, Brute> brute(model, filter, matrix);
    const std::size_t n = model.size();
    std::vector<P> placed;
    for (std::size_t i = 0; i < n; ++i)
      placed.push_back(model.primitives()[i].placed(brute.link_pose(model.links()[i])));
    std::vector<std::pair<PrimitiveId, PrimitiveId>> expected;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j) {
        const auto a = id<PrimitiveId>(i), b = id<PrimitiveId>(j);
        if (filter.admits(a, b) && closer_than(placed[i], placed[j], matrix.threshold(a, b)))
          expected.emplace_back(a, b);
      }
    brute.update_placed(placed);
    std::vector<std::pair<PrimitiveId, PrimitiveId>> found;
    for (const Hit& hit : brute.self_collisions()) found.emplace_back(hit.first, hit.second);
    EXPECT_EQ(found, expected);
  }
}

TYPED_TEST(EngineEquality, RangesOfGroupsReportEveryPairOnce) {
  using P = TypeParam;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto model = test::random_model(random, 12, 5, random.one_in(2), make_primitive<P>);
    const ExcludedPairs filter(model.size(), random, 5);
    const auto matrix = test::random_thresholds(model.size(), random);
    const Hierarchy hierarchy(model, filter, matrix);
    const auto groups = hierarchy.model().groups()->size();
    // The values of later groups must not matter: they change from one range to the next.
    Hierarchy<P, ExcludedPairs, TypedThresholds> grown(model, filter, matrix), whole = grown;
    std::vector<double> q(grown.dof_count()), chosen(grown.dof_count());
    for (double& value : chosen) value = random.uniform(-3.0, 3.0);
    whole.update(chosen);
    std::vector<Hit> found;
    for (std::size_t first = 0, end = 0; first < groups; first = end) {
      end = std::min(groups, first + 1 + random.below(4));
      for (double& value : q) value = random.uniform(-3.0, 3.0);
      for (std::size_t g = 0; g < end; ++g) {
        const std::size_t dof = (*grown.model().groups())[id<GroupId>(g)].dof;
        if (g > 0) q[dof] = chosen[dof];
      }
      grown.update(q);
      QueryOptions options;
      options.groups = {id<GroupId>(first), id<GroupId>(end)};
      const std::vector<Hit> hits = grown.self_within(0.3, options);
      EXPECT_EQ(grown.self_collides(options), !grown.self_collisions(options).empty());
      found.insert(found.end(), hits.begin(), hits.end());
    }
    std::sort(found.begin(), found.end(),
              [](const Hit& a, const Hit& b) { return std::pair(a.first, a.second) < std::pair(b.first, b.second); });
    EXPECT_EQ(found, whole.self_within(0.3));
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Hierarchy, RefusesARangeOfGroupsBetweenTwoModels) {
  Random random(1);
  const auto model = test::random_model(random, 4, 3, false, make_primitive<Point>);
  const Hierarchy one(model, AdmitAll{}, test::random_thresholds(model.size(), random));
  const Hierarchy other = one;  // NOLINT(performance-unnecessary-copy-initialization): a query needs two objects
  QueryOptions options;
  options.groups.end = GroupId{1};
  EXPECT_THROW(one.collides(other, AdmitAll{}, options), ConfigurationError);
}

TEST(Hierarchy, KeepsNoHistory) {
  Random random(1);
  const auto model = test::random_model(random, 40, 3, true, make_primitive<Point>);
  const ExcludedPairs filter(model.size(), random, 5);
  const auto matrix = test::random_thresholds(model.size(), random);
  Hierarchy old(model, filter, matrix);
  std::vector<double> q(old.dof_count());
  for (int step = 0; step < 20000; ++step) {
    for (double& value : q)
      if (random.one_in(4)) value = random.uniform(-3.0, 3.0);
    old.update(q);
    if (step % 500 != 0) continue;
    const auto hits = old.self_within(0.5);
    Hierarchy fresh(model, filter, matrix);
    fresh.update(q);
    ASSERT_EQ(hits, fresh.self_within(0.5));
  }
}

}  // namespace equality_test
}  // namespace hinge
