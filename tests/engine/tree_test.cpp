// SPDX-License-Identifier: BSD-3-Clause
// The trees of engine/simd: their contents, and every query through them against brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "engine/side_by_side.hpp"
#include "hinge/detail/engine/simd/tree/admitted_pairs.hpp"
#include "hinge/detail/engine/simd/tree/static_tree.hpp"
#include "hinge/detail/engine/simd/tree/tree_parts.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/policy/different_links.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/query/link_pair_hits.hpp"

namespace hinge {
namespace tree_test {

using test::Random;

/// Walks a tree and checks that every box contains everything below it. Returns the primitives of its leaves.
std::vector<std::uint32_t> collect(const detail::TreeStore& store, detail::BoxId root,
                                   const std::vector<detail::BuildItem>& items) {
  std::vector<std::uint32_t> found;
  std::vector<std::pair<detail::BoxId, std::vector<detail::BoxId>>> stack{{root, {}}};
  while (!stack.empty()) {
    auto [id, above] = stack.back();
    stack.pop_back();
    above.push_back(id);
    EXPECT_NE(store.nodes[id / 16].used >> id % 16 & 1U, 0U);
    if (!store.is_leaf(id)) {
      EXPECT_NE(store.nodes[id / 16].inner >> id % 16 & 1U, 0U);
      const std::uint32_t node = store.child(id);
      for (detail::BoxId lane = 0; lane < 16; ++lane)
        if ((store.nodes[node].used >> lane & 1U) != 0) stack.emplace_back(node * 16 + lane, above);
      continue;
    }
    const std::uint32_t leaf = store.leaf(id);
    for (std::size_t k = 0; k < 16; ++k) {
      const std::uint32_t primitive = store.slots[std::size_t{leaf} * 16 + k];
      if ((store.real[leaf] >> k & 1U) == 0) continue;
      found.push_back(primitive);
      for (const detail::BoxId box_id : above) {
        const detail::TreeBox box = store.box(box_id);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto middle = static_cast<double>(box.middle[axis]), half = static_cast<double>(box.half[axis]);
          EXPECT_LE(middle - half, static_cast<double>(items[primitive].lower[axis]));
          EXPECT_GE(middle + half, static_cast<double>(items[primitive].upper[axis]));
        }
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

void expect_whole(std::vector<detail::BuildItem> items, std::size_t deepest) {
  const std::vector<detail::BuildItem> as_given = items;
  detail::TreeStore store;
  detail::TreeBuilder builder;
  const detail::TreeBuilder::Tree tree = builder.build(items, store);
  const std::vector<std::uint32_t> found = collect(store, tree.root, as_given);
  ASSERT_EQ(found.size(), as_given.size());
  for (std::uint32_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k], k);
  EXPECT_LE(tree.depth, deepest);
}

detail::BuildItem item(std::size_t k, const Vec3& at, double size) {
  detail::BuildItem made{{}, {}, static_cast<std::uint32_t>(k)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    made.lower[axis] = static_cast<float>(at[static_cast<Eigen::Index>(axis)] - size);
    made.upper[axis] = static_cast<float>(at[static_cast<Eigen::Index>(axis)] + size);
  }
  return made;
}

TEST(StaticTree, HoldsEveryPrimitiveOnceInsideAllItsBoxes) {
  Random random(11);
  for (const std::size_t n : {1U, 2U, 16U, 17U, 100U, 255U, 256U, 257U, 5000U}) {
    SCOPED_TRACE(n);
    std::vector<detail::BuildItem> items;
    for (std::size_t k = 0; k < n; ++k) items.push_back(item(k, random.vector(30.0), random.uniform(0.0, 1.0)));
    expect_whole(items, n <= 16 ? 1 : n <= 256 ? 4 : 8);
  }
}

TEST(StaticTree, StaysShallowOnInputThatCannotBeCutWell) {
  std::vector<detail::BuildItem> one_point, line, exponential;
  constexpr std::size_t n = 20'000;
  for (std::size_t k = 0; k < n; ++k) {
    one_point.push_back(item(k, Vec3(1, 2, 3), 0.5));
    line.push_back(item(k, Vec3(static_cast<double>(k) * 1e-3, 0, 0), 0.0));
    exponential.push_back(item(k, Vec3(std::ldexp(1.0, -static_cast<int>(k % 120)), 0, 0), 0.0));
  }
  expect_whole(one_point, 8);
  expect_whole(line, 8);
  expect_whole(exponential, 60);
}

TEST(AdmittedPairs, KeepWhatIsLeftOutInMemoryForThatAlone) {
  Random random(12);
  for (const std::size_t n : {1U, 16U, 17U, 100U, 1000U})
    for (const std::size_t one_in : {2U, 30U, 3000U}) {
      SCOPED_TRACE(testing::Message() << "seed 12, " << n << " parts, one pair in " << one_in << " left out");
      detail::AdmittedPairs parts;
      std::vector<std::vector<bool>> tested(n, std::vector<bool>(n, false));
      for (std::size_t p = 0; p < n; ++p) {
        const std::size_t end = p - random.below(std::min<std::size_t>(p + 1, 20));
        parts.add(end);
        for (std::size_t q = 0; q < end; ++q) {
          tested[p][q] = !random.one_in(one_in);
          if (!tested[p][q]) parts.leave_out(q);
        }
      }
      for (std::size_t p = 0; p < n; ++p)
        for (std::size_t q = 0; q < (n + 15) / 16 * 16; ++q)
          ASSERT_EQ((parts.get(p, q / 16) >> q % 16 & 1U) != 0, q < n && tested[p][q]) << p << ' ' << q;
    }
  // A chain of links; each one excludes its neighbour and the base.
  const std::size_t n = 100'000;
  detail::AdmittedPairs chain;
  for (std::size_t p = 0; p < n; ++p) {
    chain.add(p);
    if (p > 0) chain.leave_out(0);
    if (p > 1) chain.leave_out(p - 1);
  }
  EXPECT_LE(chain.bytes(), 100 * n);
}

/// A chain of links with bumpy balls of triangles around their origins. Every other ball has a quarter of the size.
/// One link in `fixed_in` is fixed to its parent.
Model<Triangle> bumpy_chain(Random& random, std::size_t links, std::size_t triangles, double size,
                            std::size_t fixed_in = 4) {
  ModelBuilder<Triangle> builder;
  LinkId parent = world;
  for (std::size_t l = 0; l < links; ++l) {
    std::vector<Triangle> mesh;
    const double ball = l % 2 == 0 ? size : size / 4;
    for (std::size_t k = 0; k < triangles; ++k) {
      const double radius = ball * random.uniform(0.8, 1.0);  // drawn first with any compiler
      const Vec3 at = Vec3(random.vector(1.0).normalized()) * radius;
      mesh.push_back({at, at + random.vector(ball / 8), at + random.vector(ball / 8)});
    }
    Pose origin = random.pose(size);
    Joint joint = Revolute{Vec3(random.vector(1.0).normalized()), Vec3::Zero(), origin, {}};
    if (random.one_in(4)) joint = Prismatic{Vec3(random.vector(1.0).normalized()), origin, {}};
    if (random.one_in(fixed_in)) joint = Fixed{origin};
    parent = builder.add_link(parent, joint, mesh);
  }
  return builder.finish();
}

TEST(TreeQueries, EqualBruteForceOnLinksOfManyTriangles) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto model = bumpy_chain(random, 3, 20 + 40 * (seed % 3), 1.5);
    const DifferentLinks filter({model.links().begin(), model.links().end()});
    test::compare_with_brute<Triangle, DifferentLinks, Simd>(random, filter, model);
    if (HasFailure()) return;
  }
}

TEST(TreeQueries, EqualBruteForceWithoutThresholds) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto model = bumpy_chain(random, seed % 5 == 0 ? 3 : 6, seed % 5 == 0 ? 300 : 60, 1.0);
    const DifferentLinks filter({model.links().begin(), model.links().end()});
    Hierarchy<Triangle, DifferentLinks, UniformClearance, Simd> tested(model, filter, UniformClearance(0.0));
    Hierarchy<Triangle, DifferentLinks, UniformClearance, Brute> reference(model, filter, UniformClearance(0.0));
    LinkPairHits links(model.links());
    std::vector<double> q(tested.dof_count());
    // Half of the runs calibrate the order of pairs, which must not change any answer.
    for (int k = 0; seed % 2 == 0 && k < 10; ++k) {
      for (double& value : q) value = random.uniform(-3.0, 3.0);
      tested.update(q);
      tested.calibrate_pair_order();
    }
    for (int step = 0; step < 6; ++step) {
      for (double& value : q) value = random.uniform(-3.0, 3.0);
      tested.update(q);
      reference.update(q);
      const auto all = reference.self_collisions();
      test::expect_same(tested.self_collisions(), all);
      EXPECT_EQ(tested.self_collides(), !all.empty());
      const auto closest = tested.self_closest(), expected = reference.self_closest();
      test::expect_same(closest, expected);
      EXPECT_TRUE(all.empty() || closest->distance == 0.0);
      std::set<std::pair<LinkId, LinkId>> pairs, found;
      for (const Hit& hit : all) pairs.emplace(model.links()[index(hit.first)], model.links()[index(hit.second)]);
      links.clear();
      tested.self_query(links);
      for (const Hit& hit : links.hits())
        EXPECT_TRUE(found.emplace(model.links()[index(hit.first)], model.links()[index(hit.second)]).second);
      EXPECT_EQ(found, pairs);
    }
    if (HasFailure()) return;
  }
}

/// Queries walk the links of a rigid group together if and only if the filter admits the same partners for all of
/// them.
TEST(TreeQueries, EqualBruteForceWhereLinksOfAGroupAreTestedWithOthers) {
  int collides = 0, apart = 0, merged = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::size_t count = 6 + random.below(34);
    const auto model = bumpy_chain(random, count, 1 + random.below(40), 0.4, 2);
    const RigidGroups groups(model.tree(), DofSelection::all(model.tree()));
    std::vector<std::pair<LinkId, LinkId>> ignored;
    for (std::size_t a = 1; a <= count; ++a)
      for (std::size_t b = 1; b < a; ++b)
        if (index(groups.group_of(id<LinkId>(a))) <= index(groups.group_of(id<LinkId>(b))) + 1 ||
            random.one_in(seed % 2 == 0 ? 200 : 8))
          ignored.emplace_back(id<LinkId>(a), id<LinkId>(b));
    const DifferentLinks filter({model.links().begin(), model.links().end()}, ignored);
    Hierarchy<Triangle, DifferentLinks, UniformClearance, Simd> tested(model, filter, UniformClearance(0.0));
    Hierarchy<Triangle, DifferentLinks, UniformClearance, Brute> reference(model, filter, UniformClearance(0.0));
    const detail::TreeParts<Triangle> parts(tested.model(), filter, UniformClearance(0.0));
    merged += parts.alike.size() == 0 ? 0 : 1;
    std::vector<double> q(tested.dof_count());
    for (int step = 0; step < 8; ++step) {
      for (double& value : q) value = random.uniform(-1.5, 1.5);
      tested.update(q);
      if (seed % 4 < 2) tested.calibrate_pair_order();
      reference.update(q);
      const auto all = reference.self_collisions();
      (all.empty() ? apart : collides) += 1;
      EXPECT_EQ(tested.self_collides(), !all.empty());
      test::expect_same(tested.self_collisions(), all);
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(collides, 20);
  EXPECT_GT(apart, 20);
  EXPECT_GT(merged, 8);
}

class Refuses {
 public:
  static constexpr bool ranks = false;
  void add(const Hit&) { throw ModelError("full"); }
  double cutoff() const noexcept { return 0.0; }
  bool done() const noexcept { return false; }
};

/// If a collector throws, the next query still returns the correct answer.
TEST(TreeQueries, LetExceptionsThrough) {
  Random random(4);
  const auto model = bumpy_chain(random, 4, 50, 1.0);
  Hierarchy tree(model, DifferentLinks({model.links().begin(), model.links().end()}), UniformClearance(0.5));
  ASSERT_TRUE(tree.self_collides());
  Refuses refuses;
  EXPECT_THROW(tree.self_query(refuses), ModelError);
  EXPECT_TRUE(tree.self_collides());
}

/// Answers do not depend on the model's position or length unit: trees are stored relative to their own centres.
TEST(TreeQueries, EqualBruteForceFarFromTheOriginAndAtAnyScale) {
  for (const double size : {1e-12, 1e-3, 1.0, 1e6, 1e12})
    for (const double away : {0.0, 1e3, 1e9}) {
      SCOPED_TRACE(size);
      SCOPED_TRACE(away);
      Random random(5);
      const auto model = bumpy_chain(random, 4, 60, size);
      const DifferentLinks filter({model.links().begin(), model.links().end()});
      Hierarchy<Triangle, DifferentLinks, UniformClearance, Simd> tested(model, filter, UniformClearance(0.0));
      Hierarchy<Triangle, DifferentLinks, UniformClearance, Brute> reference(model, filter, UniformClearance(0.0));
      for (int step = 0; step < 3; ++step) {
        std::vector<Pose> poses{Pose{}};
        for (std::size_t g = 1; g < tested.model().groups()->size(); ++g) {
          poses.push_back(random.pose(size));
          poses.back().translation += Vec3::Constant(away * size);
        }
        tested.update_poses(poses);
        reference.update_poses(poses);
        test::expect_same(tested.self_collisions(), reference.self_collisions());
        const auto closest = tested.self_closest(), expected = reference.self_closest();
        ASSERT_EQ(closest.has_value(), expected.has_value());
        if (!closest) continue;
        EXPECT_NEAR(closest->distance, expected->distance, 1e-13 * (1 + away) * size);
      }
      if (HasFailure()) return;
    }
}

TEST(TreeQueries, EqualBruteForceBetweenModelsOfDifferentSizes) {
  for (const double ratio : {1e-9, 1e-3, 0.3, 1.0, 40.0, 1e7}) {
    SCOPED_TRACE(ratio);
    Random random(3);
    const auto model = bumpy_chain(random, 3, 80, 1.0), other = bumpy_chain(random, 3, 80, ratio);
    const auto filter = [](const Model<Triangle>& m) { return DifferentLinks({m.links().begin(), m.links().end()}); };
    Hierarchy<Triangle, DifferentLinks, UniformClearance, Simd> a(model, filter(model), UniformClearance(0.01)),
        b(other, filter(other), UniformClearance(0.01));
    Hierarchy<Triangle, DifferentLinks, UniformClearance, Brute> c(model, filter(model), UniformClearance(0.01)),
        d(other, filter(other), UniformClearance(0.01));
    for (int step = 0; step < 5; ++step) {
      std::vector<double> q(a.dof_count()), r(b.dof_count());
      for (double& value : q) value = random.uniform(-3.0, 3.0);
      for (double& value : r) value = random.uniform(-3.0, 3.0) * std::min(ratio, 1.0);
      a.update(q);
      c.update(q);
      b.update(r);
      d.update(r);
      test::expect_same(a.collisions(b), c.collisions(d));
      test::expect_same(b.collisions(a), d.collisions(c));
      test::expect_same(a.closest(b), c.closest(d));
      EXPECT_EQ(a.collides(b), c.collides(d));
      EXPECT_EQ(b.collides(a), c.collides(d));
      // Calibrating the order of link pairs must not change any answer.
      if (step > 0) a.calibrate_pair_order(b);
    }
    if (HasFailure()) return;
  }
}

}  // namespace tree_test
}  // namespace hinge
