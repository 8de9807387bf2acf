// SPDX-License-Identifier: BSD-3-Clause
// Tree queries do not allocate memory.
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "engine/count_allocations.hpp"
#include "engine/random_mechanism.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/policy/different_links.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/query/link_pair_hits.hpp"

namespace hinge {
namespace allocation_test {

using test::allocations;

TEST(TreeQueries, AllocateNothing) {
  test::Random random(8);
  ModelBuilder<Triangle> builder;
  LinkId parent = world;
  for (int l = 0; l < 12; ++l) {
    std::vector<Triangle> mesh;
    for (int k = 0; k < 300; ++k) {
      const Vec3 at = Vec3(random.vector(1.0).normalized()) * 0.15;
      mesh.push_back({at, at + random.vector(0.03), at + random.vector(0.03)});
    }
    parent = builder.add_link(parent, Revolute{Vec3::UnitX(), Vec3::Zero(), random.pose(1.0), {}}, mesh);
  }
  const auto model = builder.finish();
  Hierarchy robot(model, DifferentLinks({model.links().begin(), model.links().end()}), UniformClearance(0.0));
  LinkPairHits links(model.links());
  std::vector<double> q(robot.dof_count());
  std::size_t hits = 0;
  const auto ask = [&] {
    for (double& value : q) value = random.uniform(-3.0, 3.0);
    robot.update(q);
    AnyHit any;
    robot.self_query(any);
    links.clear();
    robot.self_query(links);
    Closest closest;
    robot.self_query(closest);
    hits += any.done() ? 1U : 0U;
  };
  // The caller owns the list of hits. It grows until it fits the largest answer.
  for (int k = 0; k < 200; ++k) ask();
  const std::size_t before = allocations;
  for (int k = 0; k < 100; ++k) ask();
  EXPECT_EQ(allocations, before);
  EXPECT_GT(hits, 0U);
  EXPECT_LT(hits, 300U);
}

}  // namespace allocation_test
}  // namespace hinge
