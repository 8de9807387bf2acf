// SPDX-License-Identifier: BSD-3-Clause
// The worked example of docs/explanation/how_it_works.md, with its numbers.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "hinge/engine/brute.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge {
namespace worked_example_test {

/// Excludes neighbours along the chain.
class NotNeighbours {
 public:
  explicit NotNeighbours(std::size_t n) : excluded_(n) {
    for (std::size_t i = 0; i + 1 < n; ++i) {
      excluded_[i].push_back(id<PrimitiveId>(i + 1));
      excluded_[i + 1].insert(excluded_[i + 1].begin(), id<PrimitiveId>(i));
    }
  }
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    return index(i) + 1 != index(j) && index(j) + 1 != index(i);
  }
  std::span<const PrimitiveId> excluded(PrimitiveId i) const noexcept { return excluded_[index(i)]; }

 private:
  std::vector<std::vector<PrimitiveId>> excluded_;
};

/// The planar chain of the page's figure: 48 points, each 1 from the next.
std::vector<Vec3> chain() {
  std::vector<Vec3> points;
  for (int x = 0; x <= 20; ++x) points.emplace_back(x, 0, 0);
  for (int y = 1; y <= 4; ++y) points.emplace_back(20, y, 0);
  for (int x = 19; x >= 4; --x) points.emplace_back(x, 4, 0);
  for (int y = 3; y >= 1; --y) points.emplace_back(4, y, 0);
  for (const Vec3& last : {Vec3(3, 1, 0), Vec3(2, 1, 0), Vec3(1.2, 0.4, 0), Vec3(0.4, 1, 0)}) points.push_back(last);
  return points;
}

TEST(WorkedExample, HasTheNumbersOfThePage) {
  const std::vector<Vec3> points = chain();
  ASSERT_EQ(points.size(), 48U);
  for (std::size_t k = 1; k < points.size(); ++k) EXPECT_NEAR((points[k] - points[k - 1]).norm(), 1.0, 1e-15);
  ModelBuilder<Point> builder;
  for (const Vec3& x : points) {
    // Every point moves by itself.
    builder.add_link(world, Prismatic{Vec3::UnitX(), {Mat3::Identity(), x}, {}}, {Point{Vec3::Zero()}});
  }
  const Model<Point> model = builder.finish();
  const NotNeighbours filter(points.size());
  Hierarchy simd(model, filter, UniformClearance{0.8});
  Hierarchy<Point, NotNeighbours, UniformClearance, Brute> brute(model, filter, UniformClearance{0.8});

  std::size_t admitted = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) admitted += filter.admits(id<PrimitiveId>(i), id<PrimitiveId>(j)) ? 1U : 0U;
  EXPECT_EQ(admitted, 1081U);
  EXPECT_EQ(brute.self_collisions().size(), 1U);

  QueryCounts counts;
  QueryOptions options;
  options.counts = &counts;
  ASSERT_TRUE(simd.self_collides(options));
  EXPECT_EQ(counts.pairs_tested, 43U * 16U) << "43 candidates of sixteen lanes";
  const std::vector<Hit> hits = simd.self_collisions();
  ASSERT_EQ(hits.size(), 1U);
  EXPECT_EQ(hits[0].first, PrimitiveId{1});
  EXPECT_EQ(hits[0].second, PrimitiveId{46});
  EXPECT_NEAR(hits[0].distance, std::sqrt(0.2), 1e-15);
}

}  // namespace worked_example_test
}  // namespace hinge
