// SPDX-License-Identifier: BSD-3-Clause
// The stock policies keep the laws, and the laws catch policies that do not.
#include "laws/laws.hpp"

#include <gtest/gtest-spi.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/policy/different_links.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/query/collectors.hpp"

namespace hinge {
namespace {

using test::Random;

std::vector<Pose> poses(Random& random) { return {random.pose(1.0), random.pose(100.0), random.pose(1e4)}; }

template <class Make>
void check(std::uint64_t seed, const Make& make) {
  for (const double size : {1e-6, 1.0, 1e6}) {
    Random random(seed);
    std::vector<decltype(make(random, size))> samples;
    for (int k = 0; k < 25; ++k) samples.push_back(make(random, size));
    laws::check_primitive(std::span<const decltype(make(random, size))>(samples), poses(random));
  }
}

TEST(PrimitiveLaws, HoldForPoint) {
  check(1, [](Random& r, double size) { return Point{r.vector(size)}; });
}
TEST(PrimitiveLaws, HoldForSphere) {
  check(2, [](Random& r, double size) { return Sphere{r.vector(size), r.uniform(0.0, size / 2)}; });
}
TEST(PrimitiveLaws, HoldForCapsule) {
  check(3, [](Random& r, double size) {
    const Vec3 a = r.vector(size);
    return Capsule{a, r.one_in(4) ? a : r.vector(size), r.one_in(4) ? 0.0 : r.uniform(0.0, size / 4)};
  });
}
TEST(PrimitiveLaws, HoldForTriangleDegenerateOnesIncluded) {
  check(4, [](Random& r, double size) {
    const Vec3 a = r.vector(size), b = r.one_in(5) ? a : r.vector(size);
    return Triangle{a, b, r.one_in(5) ? b : r.vector(size)};
  });
}

TEST(FilterLaws, HoldForStockFilters) {
  Random random(5);
  laws::check_pair_filter(AdmitAll{}, 10);
  laws::check_pair_filter(test::ExcludedPairs(30, random, 4), 30);
  const LinkId a{1}, b{2}, c{3};
  laws::check_pair_filter(DifferentLinks({a, a, b, c, c}, {{a, b}}), 5);
  EXPECT_FALSE(DifferentLinks({a, b}, {{b, a}}).admits(PrimitiveId{0}, PrimitiveId{1}));
  EXPECT_FALSE(DifferentLinks({a, a}).admits(PrimitiveId{0}, PrimitiveId{1}));
  EXPECT_TRUE(DifferentLinks({a, b}).admits(PrimitiveId{0}, PrimitiveId{1}));
}

TEST(MatrixLaws, HoldForStockMatrices) {
  Random random(6);
  laws::check_distance_matrix(UniformClearance{0.3}, 5);
  laws::check_distance_matrix(test::random_thresholds(20, random), 20);
}

TEST(CollectorLaws, HoldForTheFourModes) {
  Random random(7);
  std::vector<Hit> hits;
  for (std::uint32_t k = 0; k < 50; ++k)
    hits.push_back({PrimitiveId{k}, PrimitiveId{k + 1}, random.uniform(0.0, 3.0), random.uniform(0.0, 3.0)});
  laws::check_collector(AnyHit{}, hits);
  laws::check_collector(HitsWithin{}, hits);
  laws::check_collector(HitsWithin{0.5}, hits);
  laws::check_collector(Closest{}, hits);
}

/// Bounds too small for the radius.
struct Liar {
  Vec3 center;
  Liar placed(const Pose& pose) const noexcept { return {pose * center}; }
  Aabb bounds() const noexcept { return Aabb(center); }
  friend double squared_distance(const Liar& p, const Liar& q) noexcept {
    const double d = std::max(0.0, std::sqrt(squared_norm(Vec3(p.center - q.center))) - 1.0);
    return d * d;
  }
};

struct OneSided {
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept { return i < j; }
};

struct ShortReach {
  double threshold(PrimitiveId, PrimitiveId) const noexcept { return 1.0; }
  double reach(PrimitiveId) const noexcept { return 0.4; }
};

TEST(Laws, CatchBoundsThatDoNotHoldThePrimitive) {
  testing::TestPartResultArray failures;
  {
    testing::ScopedFakeTestPartResultReporter reporter(
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &failures);
    const std::vector<Liar> samples{{Vec3(0, 0, 0)}, {Vec3(5, 0, 0)}};
    laws::check_primitive(std::span<const Liar>(samples), std::span<const Pose>());
  }
  EXPECT_GT(failures.size(), 0);
}

TEST(Laws, CatchAsymmetricFilters) {
  testing::TestPartResultArray failures;
  {
    testing::ScopedFakeTestPartResultReporter reporter(
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &failures);
    laws::check_pair_filter(OneSided{}, 3);
  }
  EXPECT_GT(failures.size(), 0);
}

TEST(Laws, CatchReachesThatDoNotCoverThresholds) {
  testing::TestPartResultArray failures;
  {
    testing::ScopedFakeTestPartResultReporter reporter(
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &failures);
    laws::check_distance_matrix(ShortReach{}, 2);
  }
  EXPECT_GT(failures.size(), 0);
}

}  // namespace
}  // namespace hinge
