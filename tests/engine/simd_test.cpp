// SPDX-License-Identifier: BSD-3-Clause
// engine/simd against brute force: random mechanisms with small, large and very large groups.
#include "hinge/engine/simd.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/side_by_side.hpp"

namespace hinge {
namespace simd_test {

using test::compare_with_brute;
using test::ExcludedPairs;
using test::make_primitive;
using test::Random;

template <class P>
class SimdEquality : public testing::Test {};
TYPED_TEST_SUITE(SimdEquality, test::Primitives);

TYPED_TEST(SimdEquality, HoldsOnRandomMechanisms) {
  using P = TypeParam;
  // Brute force takes a microsecond per pair of extended primitives, so they have few large cases.
  const std::uint64_t seeds = std::is_same_v<P, Point> ? 300 : 100;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::size_t per_link = seed % (std::is_same_v<P, Point> ? 3 : 25) == 0 ? 60 : 6;
    const auto model = test::random_model(random, 12, per_link, random.one_in(2), make_primitive<P>);
    ExcludedPairs filter(model.size(), random, 5);
    if (random.one_in(2)) filter.list_nothing();
    compare_with_brute<P, ExcludedPairs, Simd>(random, filter, model);
    if (testing::Test::HasFailure()) return;
  }
}

/// Fewer static primitives than a block holds. Nothing comes near them until after a call of update_placed().
TEST(Simd, KeepsStaticBlocksThroughCoordinatesFromElsewhere) {
  ModelBuilder<Point> builder;
  builder.add_link(world, Fixed{}, {Point{{0, 0, 0}}, Point{{0, 7, 0}}});
  for (int k = 0; k < 8; ++k) {
    std::vector<Point> points;
    for (int l = 0; l < 16; ++l) points.push_back({Vec3(100 + 10 * k + 0.3 * l, 7, 0)});
    builder.add_link(world, Prismatic{{1, 0, 0}, {}, {}}, points);
  }
  Hierarchy<Point, AdmitAll, UniformClearance, Simd> simd(builder.finish(), AdmitAll{}, UniformClearance(0.5));
  std::vector<double> q(8, 0.0);
  simd.update(q);
  EXPECT_FALSE(simd.self_collides());
  std::vector<Point> elsewhere(simd.placed().begin(), simd.placed().end());
  for (Point& p : elsewhere) p.position *= 3;
  simd.update_placed(elsewhere);
  EXPECT_FALSE(simd.self_collides());
  q[5] = 1;
  simd.update(q);
  EXPECT_FALSE(simd.self_collides());
  q[0] = -100.1;  // one value of eight changes, so the engine does not test unmoved pairs again
  simd.update(q);
  EXPECT_EQ(simd.self_collisions().size(), 2U);
}

}  // namespace simd_test
}  // namespace hinge
