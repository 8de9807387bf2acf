// SPDX-License-Identifier: BSD-3-Clause
// The trees of engine/lazy: shape, depth on clustered input, and traversal.
#include "hinge/detail/engine/lazy_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/detail/engine/traversal.hpp"

namespace hinge {
namespace lazy_tree_test {

using test::Random;

void split_all(detail::LazyTree& tree) {
  for (std::uint32_t k = 0; k < tree.node_count(); ++k)
    if (!tree.node(k).is_leaf()) tree.split(k);
}

std::uint32_t depth(const detail::LazyTree& tree) {
  std::uint32_t deepest = 0;
  for (std::uint32_t k = 0; k < tree.node_count(); ++k) deepest = std::max(deepest, tree.node(k).depth);
  return deepest;
}

std::uint32_t depth_bound(std::size_t n) { return 3 * static_cast<std::uint32_t>(std::bit_width(n - 1)) + 9; }

TEST(LazyTree, IsWellFormedForSizesOneToForty) {
  Random random(3);
  for (std::size_t n = 1; n <= 40; ++n) {
    std::vector<Aabb> boxes;
    for (std::size_t k = 0; k < n; ++k) boxes.push_back(Aabb(random.vector(5.0)).inflated(random.uniform(0.0, 2.0)));
    detail::LazyTree tree;
    tree.reset(boxes);
    EXPECT_EQ(tree.node_count(), 1U);
    split_all(tree);
    EXPECT_EQ(tree.node_count(), 2 * n - 1);
    EXPECT_TRUE(check_well_formed(tree, boxes));
  }
}

TEST(LazyTree, SplitsAtTheMiddleOfTheWidestAxis) {
  std::vector<Aabb> boxes;
  for (const double x : {0.0, 1.0, 2.0, 9.0}) boxes.emplace_back(Vec3(x, 0.0, 0.0), Vec3(x + 0.5, 1.0, 1.0));
  detail::LazyTree tree;
  tree.reset(boxes);
  ASSERT_TRUE(tree.split(0));
  EXPECT_FALSE(tree.split(0));
  EXPECT_EQ(tree.node(1).size(), 3U);
  EXPECT_EQ(tree.node(2).size(), 1U);
}

TEST(LazyTree, PutsALongBoxAloneToTheLeft) {
  std::vector<Aabb> boxes{Aabb(Vec3(0, 0, 0), Vec3(1, 1, 1)), Aabb(Vec3(1, 0, 0), Vec3(8, 1, 1)),
                          Aabb(Vec3(9, 0, 0), Vec3(10, 1, 1))};
  detail::LazyTree tree;
  tree.reset(boxes);
  tree.split(0);
  ASSERT_TRUE(tree.node(1).is_leaf());
  EXPECT_EQ(tree.item(tree.node(1)), 1U);
}

TEST(LazyTree, StaysWithinItsDepthBoundOnClusteredInput) {
  const std::size_t n = 20000;
  Random random(5);
  std::vector<std::vector<Aabb>> inputs(4);
  for (std::size_t k = 0; k < n; ++k) {
    inputs[0].push_back(Aabb(Vec3(1.0, 2.0, 3.0)).inflated(1.5));                        // all at one point
    inputs[1].push_back(Aabb(random.vector(1e-6)).inflated(1.5));                        // one small cluster
    inputs[2].push_back(Aabb(Vec3(std::ldexp(1.0, static_cast<int>(k % 1000)), 0, 0)));  // exponential spacing
    inputs[3].push_back(Aabb(Vec3(static_cast<double>(k), 0, 0)));                       // on a line
  }
  for (const auto& boxes : inputs) {
    detail::LazyTree tree;
    tree.reset(boxes);
    split_all(tree);
    EXPECT_LE(depth(tree), depth_bound(n));
    EXPECT_TRUE(check_well_formed(tree, boxes));
  }
  detail::LazyTree line;
  line.reset(inputs[3]);
  split_all(line);
  EXPECT_LE(depth(line), 15U + 6U) << "natural input never reaches the guard";
}

TEST(Traversal, VisitsEveryOverlappingPairOnceAndNoLeafWithItself) {
  Random random(9);
  for (const std::size_t n : {1U, 2U, 3U, 50U}) {
    std::vector<Aabb> boxes;
    for (std::size_t k = 0; k < n; ++k) boxes.push_back(Aabb(random.vector(3.0)).inflated(0.5));
    detail::LazyTree tree;
    tree.reset(boxes);
    detail::NodePairs stack;
    QueryCounts counts;
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> found, expected;
    traverse(
        tree, tree, stack, counts, [] { return 0.0; },
        [&](std::uint32_t a, std::uint32_t b) {
          found.emplace(std::min(a, b), std::max(a, b));
          return true;
        });
    for (std::uint32_t a = 0; a < n; ++a)
      for (std::uint32_t b = a + 1; b < n; ++b)
        if (overlap(boxes[a], boxes[b])) expected.emplace(a, b);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(counts.nodes_split > 0, n > 1);
  }
}

}  // namespace lazy_tree_test
}  // namespace hinge
