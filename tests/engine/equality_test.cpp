// SPDX-License-Identifier: BSD-3-Clause
// Every query on every engine equals brute force, and brute force equals a plain double loop written here.
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge {
namespace {

using test::ExcludedPairs;
using test::Random;
using test::UnlistedPairs;

template <class P>
P make_primitive(Random& random, const Vec3& axis, const Vec3& point);

template <>
Point make_primitive(Random& random, const Vec3& axis, const Vec3& point) {
  if (random.one_in(4)) return Point{point + axis * random.uniform(-2.0, 2.0)};
  return Point{random.vector(4.0)};
}
template <>
Sphere make_primitive(Random& random, const Vec3& axis, const Vec3& point) {
  return Sphere{make_primitive<Point>(random, axis, point).position, random.uniform(0.0, 0.6)};
}
template <>
Capsule make_primitive(Random& random, const Vec3& axis, const Vec3& point) {
  if (random.one_in(5)) return Capsule{point, point + axis, random.uniform(0.0, 0.4)};
  const Vec3 a = random.vector(4.0);
  return Capsule{a, a + random.vector(1.0), random.uniform(0.0, 0.4)};
}
template <>
Triangle make_primitive(Random& random, const Vec3&, const Vec3&) {
  const Vec3 a = random.vector(4.0);
  return Triangle{a, a + random.vector(1.0), a + random.vector(1.0)};
}

/// Hits compare by pair and distance; engines may look at (p, q) or (q, p), so distances agree to rounding only.
void expect_same(const std::vector<Hit>& a, const std::vector<Hit>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].first, b[k].first);
    EXPECT_EQ(a[k].second, b[k].second);
    EXPECT_NEAR(a[k].distance, b[k].distance, 1e-12);
    EXPECT_EQ(a[k].threshold, b[k].threshold);
  }
}

void expect_same(const std::optional<Hit>& a, const std::optional<Hit>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a) {
    EXPECT_NEAR(a->gap(), b->gap(), 1e-12);
  }
}

template <class P>
class EngineEquality : public testing::Test {};
using Primitives = testing::Types<Point, Sphere, Capsule, Triangle>;
TYPED_TEST_SUITE(EngineEquality, Primitives);

/// Two hierarchies of one model, side by side in every state.
template <class P, class F, template <class, class, class> class EngineOf>
class Pair {
 public:
  using Tested = Hierarchy<P, F, TypedThresholds, EngineOf>;
  using Reference = Hierarchy<P, F, TypedThresholds, Brute>;
  Pair(const Model<P>& model, const DofSelection& selection, const F& filter, const TypedThresholds& matrix)
      : tested(model, selection, filter, matrix), reference(model, selection, filter, matrix) {}

  void compare(Random& random) {
    QueryOptions options;
    std::vector<double> clearance;
    if (random.one_in(3)) {
      for (std::size_t g = 0; g < tested.model().groups()->size(); ++g) clearance.push_back(random.uniform(0.0, 1.0));
      options.clearance = clearance;
    }
    options.moved_only = random.one_in(3);
    const auto all = tested.self_collisions(options);
    expect_same(all, reference.self_collisions(options));
    expect_same(tested.self_within(0.7, options), reference.self_within(0.7, options));
    expect_same(tested.self_closest(options), reference.self_closest(options));
    EXPECT_EQ(tested.self_collides(options), !all.empty());
    EXPECT_EQ(reference.self_collides(options), !all.empty());
  }
  void compare_with(Pair& other, Random& random) {
    QueryOptions options;
    options.moved_only = random.one_in(3);
    const auto all = tested.collisions(other.tested, AdmitAll{}, options);
    expect_same(all, reference.collisions(other.reference, AdmitAll{}, options));
    expect_same(tested.within(other.tested, 0.7, AdmitAll{}, options),
                reference.within(other.reference, 0.7, AdmitAll{}, options));
    expect_same(tested.closest(other.tested, AdmitAll{}, options),
                reference.closest(other.reference, AdmitAll{}, options));
    EXPECT_EQ(tested.collides(other.tested, AdmitAll{}, options), !all.empty());
  }

  Tested tested;
  Reference reference;
};

template <class P, class F, template <class, class, class> class EngineOf>
void run(Random& random, const F& filter, const Model<P>& model) {
  const auto matrix = test::random_thresholds(model.size(), random);
  const DofSelection selection = test::random_selection(model.tree(), random);
  Pair<P, F, EngineOf> pair(model, selection, filter, matrix);
  Pair<P, F, EngineOf> other = pair;
  pair.compare(random);
  std::vector<double> q(selection.size());
  for (int step = 0; step < 6; ++step) {
    for (double& value : q)
      if (random.one_in(2)) value = random.uniform(-3.0, 3.0);
    pair.tested.update(q);
    pair.reference.update(q);
    pair.compare(random);
    if (step % 3 == 0) {
      other.tested.update(q);
      other.reference.update(q);
    }
    pair.compare_with(other, random);
    if (step == 2) {
      const auto placed = pair.tested.placed();
      const std::vector<P> copy(placed.begin(), placed.end());
      pair.tested.update_placed(copy);
      pair.reference.update_placed(copy);
      pair.compare(random);
    }
    if (step == 4) {
      std::vector<Pose> poses(pair.tested.model().groups()->size());
      for (std::size_t g = 1; g < poses.size(); ++g) poses[g] = random.pose(2.0);
      pair.tested.update_poses(poses);
      pair.reference.update_poses(poses);
      pair.compare(random);
    }
  }
  expect_same(pair.tested.constant_contacts(), pair.reference.constant_contacts());
}

TYPED_TEST(EngineEquality, LazyEqualsBruteOnRandomMechanisms) {
  using P = TypeParam;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto model = test::random_model(random, 12, 5, random.one_in(2), make_primitive<P>);
    const ExcludedPairs filter(model.size(), random, 5);
    if (random.one_in(2))
      run<P, ExcludedPairs, Lazy>(random, filter, model);
    else
      run<P, UnlistedPairs, Lazy>(random, UnlistedPairs{filter}, model);
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

}  // namespace
}  // namespace hinge
