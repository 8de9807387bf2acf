// SPDX-License-Identifier: BSD-3-Clause
// Runs every query on two hierarchies of one random mechanism in every state; one of the two is brute force.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::test {

/// A random primitive in the frame of a link; some are on the joint axis (direction `axis`, through `point`).
template <class P>
P make_primitive(Random& random, const Vec3& axis, const Vec3& point);

template <>
inline Point make_primitive(Random& random, const Vec3& axis, const Vec3& point) {
  if (random.one_in(4)) return Point{point + axis * random.uniform(-2.0, 2.0)};
  return Point{random.vector(4.0)};
}
template <>
inline Sphere make_primitive(Random& random, const Vec3& axis, const Vec3& point) {
  return Sphere{make_primitive<Point>(random, axis, point).position, random.uniform(0.0, 0.6)};
}
template <>
inline Capsule make_primitive(Random& random, const Vec3& axis, const Vec3& point) {
  if (random.one_in(5)) return Capsule{point, point + axis, random.uniform(0.0, 0.4)};
  const Vec3 a = random.vector(4.0);
  return Capsule{a, a + random.vector(1.0), random.uniform(0.0, 0.4)};
}
template <>
inline Triangle make_primitive(Random& random, const Vec3&, const Vec3&) {
  const Vec3 a = random.vector(4.0);
  return Triangle{a, a + random.vector(1.0), a + random.vector(1.0)};
}

/// Pairs and thresholds must be equal. Distances agree to rounding only: engines may test (p, q) or (q, p).
inline void expect_same(const std::vector<Hit>& a, const std::vector<Hit>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].first, b[k].first);
    EXPECT_EQ(a[k].second, b[k].second);
    EXPECT_NEAR(a[k].distance, b[k].distance, 1e-12);
    EXPECT_EQ(a[k].threshold, b[k].threshold);
  }
}

inline void expect_same(const std::optional<Hit>& a, const std::optional<Hit>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a) {
    EXPECT_NEAR(a->gap(), b->gap(), 1e-12);
  }
}

using Primitives = testing::Types<Point, Sphere, Capsule, Triangle>;

/// Two hierarchies of one model that always have the same state.
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
    if (random.one_in(3)) {
      const std::size_t groups = tested.model().groups()->size();
      options.groups = {id<GroupId>(random.below(groups + 1)), id<GroupId>(random.below(groups + 2))};
    }
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

/// Compares all queries of EngineOf with brute force in several states, set through every kind of update.
template <class P, class F, template <class, class, class> class EngineOf>
void compare_with_brute(Random& random, const F& filter, const Model<P>& model) {
  const auto matrix = random_thresholds(model.size(), random);
  const DofSelection selection = random_selection(model.tree(), random);
  Pair<P, F, EngineOf> pair(model, selection, filter, matrix);
  Pair<P, F, EngineOf> other = pair;
  pair.compare(random);
  std::vector<double> q(selection.size());
  for (int step = 0; step < 6; ++step) {
    // Every other step changes so few values that engines search for unmoved groups.
    const std::size_t changed = step % 2 == 0 ? 2 : 10;
    for (double& value : q)
      if (random.one_in(changed)) value = random.uniform(-3.0, 3.0);
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

}  // namespace hinge::test
