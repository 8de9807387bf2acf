// SPDX-License-Identifier: BSD-3-Clause
// The stock policies keep the laws, and the law checks find policies that break them.
#include "hinge/policy/laws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/policy/different_links.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/query/collectors.hpp"

namespace hinge {
namespace laws_test {

using test::Random;

std::vector<Pose> poses(Random& random) { return {random.pose(1.0), random.pose(100.0), random.pose(1e4)}; }

const laws::Violations none;

template <class Make>
void check(std::uint64_t seed, const Make& make) {
  for (const double size : {1e-6, 1.0, 1e6}) {
    Random random(seed);
    std::vector<decltype(make(random, size))> samples;
    for (int k = 0; k < 25; ++k) samples.push_back(make(random, size));
    EXPECT_EQ(laws::check_primitive(std::span<const decltype(make(random, size))>(samples), poses(random)), none);
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
  EXPECT_EQ(laws::check_pair_filter(AdmitAll{}, 10), none);
  const test::ExcludedPairs listed(30, random, 4), many(300, random, 4);
  EXPECT_EQ(laws::check_pair_filter(listed, 30), none);
  EXPECT_EQ(laws::check_refinements(many, std::vector<LinkId>(300, world)), none);
  const LinkId a{1}, b{2}, c{3};
  const std::vector<LinkId> links{a, a, b, c, c};
  EXPECT_EQ(laws::check_pair_filter(DifferentLinks(links, {{a, b}}), 5, links), none);
  EXPECT_EQ(laws::check_refinements(DifferentLinks(links, {{a, b}}), links), none);
  EXPECT_FALSE(DifferentLinks({a, b}, {{b, a}}).admits(PrimitiveId{0}, PrimitiveId{1}));
  EXPECT_FALSE(DifferentLinks({a, a}).admits(PrimitiveId{0}, PrimitiveId{1}));
  EXPECT_TRUE(DifferentLinks({a, b}).admits(PrimitiveId{0}, PrimitiveId{1}));
}

TEST(MatrixLaws, HoldForStockMatrices) {
  Random random(6);
  EXPECT_EQ(laws::check_distance_matrix(UniformClearance{0.3}, 5), none);
  EXPECT_EQ(laws::check_distance_matrix(test::random_thresholds(20, random), 20), none);
}

/// Half of an odd number of the smallest denormals must be rounded.
TEST(MatrixLaws, HoldForDenormalThresholds) {
  for (const double m : {1 * 0x1p-1074, 3 * 0x1p-1074, 5 * 0x1p-1074, 0x1p-1022 - 0x1p-1074}) {
    EXPECT_EQ(laws::check_distance_matrix(TypedThresholds({0, 0}, 1, {m}), 2), none) << m;
    EXPECT_EQ(laws::check_distance_matrix(UniformClearance{m}, 2), none) << m;
  }
}

TEST(CollectorLaws, HoldForTheFourModes) {
  Random random(7);
  std::vector<Hit> hits;
  for (std::uint32_t k = 0; k < 50; ++k)
    hits.push_back({PrimitiveId{k}, PrimitiveId{k + 1}, random.uniform(0.0, 3.0), random.uniform(0.0, 3.0)});
  EXPECT_EQ(laws::check_collector(AnyHit{}, hits), none);
  EXPECT_EQ(laws::check_collector(HitsWithin{}, hits), none);
  EXPECT_EQ(laws::check_collector(HitsWithin{0.5}, hits), none);
  EXPECT_EQ(laws::check_collector(Closest{}, hits), none);
}

/// Its bounds ignore its radius.
struct Liar {
  Vec3 center;
  Liar placed(const Pose& pose) const noexcept { return {pose * center}; }
  Aabb bounds() const noexcept { return Aabb(center); }
  friend double squared_distance(const Liar& p, const Liar& q) noexcept {
    const double d = std::max(0.0, std::sqrt(squared_norm(Vec3(p.center - q.center))) - 1.0);
    return d * d;
  }
};

/// A ball of radius 1 whose hull is what its parameters say.
template <int radius_percent, bool moves, bool fills>
struct HullLiar {
  static constexpr bool fills_hull = fills;
  Vec3 center, first = center;
  HullLiar placed(const Pose& pose) const noexcept { return {pose * center, moves ? Vec3(pose * center) : first}; }
  Aabb bounds() const noexcept { return Aabb(center).inflated(1.0); }
  std::array<Vec3, 1> hull() const noexcept { return {first}; }
  double hull_radius() const noexcept { return radius_percent / 100.0; }
  friend double squared_distance(const HullLiar& p, const HullLiar& q) noexcept {
    const double d = std::max(0.0, std::sqrt(squared_norm(Vec3(p.center - q.center))) - 2.0);
    return d * d;
  }
};

template <class P>
laws::Violations check_hull_of() {
  const std::vector<P> samples{{Vec3(0, 0, 0)}, {Vec3(5, 5, 0)}};
  const std::vector<Pose> poses{Pose{}, Pose{rotation_about(Vec3::UnitZ(), 0.7), Vec3(1, 2, 3)}};
  return laws::check_primitive(std::span<const P>(samples), std::span<const Pose>(poses));
}

struct OneSided {
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept { return i < j; }
};

struct ShortReach {
  double threshold(PrimitiveId, PrimitiveId) const noexcept { return 1.0; }
  double reach(PrimitiveId) const noexcept { return 0.4; }
};

/// Lists a pair as excluded that it admits.
struct LooseList {
  PrimitiveId fifth{5};
  bool admits(PrimitiveId, PrimitiveId) const noexcept { return true; }
  std::span<const PrimitiveId> excluded(PrimitiveId i) const noexcept {
    return index(i) == 2 ? std::span(&fifth, 1) : std::span<const PrimitiveId>();
  }
};

/// Excludes two links but admits pairs of their primitives.
struct LooseLinks : DifferentLinks {
  using DifferentLinks::admits;
  using DifferentLinks::DifferentLinks;
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept { return i != j; }
};

struct GrowingCutoff {
  static constexpr bool ranks = false;
  double most = 0.0;
  void add(const Hit&) { most += 1.0; }
  double cutoff() const noexcept { return most; }
  bool done() const noexcept { return most > 0.5 && most < 1.5; }
};

/// Expects that the first violation contains all words.
void expect_told(const laws::Violations& broken, const std::vector<std::string>& words) {
  ASSERT_FALSE(broken.empty());
  EXPECT_LE(broken.size(), 20U);
  for (const std::string& word : words)
    EXPECT_NE(broken.front().find(word), std::string::npos) << word << " in: " << broken.front();
}

TEST(Laws, CatchBoundsThatDoNotHoldThePrimitive) {
  const std::vector<Liar> samples{{Vec3(0, 0, 0)}, {Vec3(5, 0, 0)}};
  expect_told(laws::check_primitive(std::span<const Liar>(samples), std::span<const Pose>()),
              {"samples 0 and 1", "bounds"});
}

TEST(Laws, CatchHullsThatDoNotHoldThePrimitive) {
  EXPECT_EQ((check_hull_of<HullLiar<100, true, true>>()), none);
  EXPECT_EQ((check_hull_of<HullLiar<150, true, false>>()), none);
  expect_told(check_hull_of<HullLiar<99, true, true>>(), {"samples 0 and 1", "closer than their hulls"});
  expect_told(check_hull_of<HullLiar<101, true, true>>(), {"samples 0 and 1", "do not fill"});
  expect_told(check_hull_of<HullLiar<100, false, true>>(), {"sample 0", "does not move"});
}

TEST(Laws, CatchAsymmetricFilters) {
  expect_told(laws::check_pair_filter(OneSided{}, 3), {"primitives 0 and 1", "swapped"});
}

TEST(Laws, CatchListsOfAdmittedPairs) {
  expect_told(laws::check_pair_filter(LooseList{}, 6), {"primitives 2 and 5", "excluded(2)"});
  const std::vector<LinkId> links(1000, world);  // so many that pairs are sampled, but listed pairs are all tested
  expect_told(laws::check_refinements(LooseList{}, links), {"primitives 2 and 5", "excluded(2)"});
}

TEST(Laws, CatchRefusedLinksOfAdmittedPairs) {
  const std::vector<LinkId> links{LinkId{1}, LinkId{2}, LinkId{3}};
  const LooseLinks filter(links, {{LinkId{1}, LinkId{3}}});
  expect_told(laws::check_pair_filter(filter, 3, links), {"primitives 0 and 2", "links 1 and 3"});
  expect_told(laws::check_refinements(filter, links), {"primitives 0 and 2", "links 1 and 3"});
  expect_told(laws::check_refinements(filter, links, links), {"of the two models", "links"});
}

TEST(Laws, CatchReachesThatDoNotCoverThresholds) {
  expect_told(laws::check_distance_matrix(ShortReach{}, 2), {"primitives 0 and 0", "reaches"});
}

TEST(Laws, CatchCollectorsThatGoBack) {
  const std::vector<Hit> hits(2);
  const laws::Violations broken = laws::check_collector(GrowingCutoff{}, hits);
  expect_told(broken, {"hit 0", "cutoff"});
  EXPECT_EQ(broken.size(), 3U);  // the cutoff is broken twice, done() once
}

}  // namespace laws_test
}  // namespace hinge
