// SPDX-License-Identifier: BSD-3-Clause
// Tests extremes of atoms on all three engines, one test per row of the table of extremes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "extremes/three_engines.hpp"

namespace hinge {
namespace atoms_test {

using test::AnyEngine;
using test::atoms_on_three_engines;
using test::one_type;
using test::own_groups;
using test::Random;

std::vector<AnyEngine<Point>> atoms(const std::vector<Vec3>& points, double m) {
  return atoms_on_three_engines(own_groups(points), one_type(points.size(), m));
}

TEST(Atoms, WithAThresholdOfZeroNeverHitEvenWhenCoincident) {
  for (AnyEngine<Point>& engine : atoms(std::vector<Vec3>(1000, Vec3(1, 2, 3)), 0.0)) {
    SCOPED_TRACE(engine.name);
    EXPECT_FALSE(engine.collides({}));
    EXPECT_TRUE(engine.within(0.0, {}).empty());
    EXPECT_EQ(engine.closest({}).value().gap(), 0.0);
  }
  // A type has only thresholds of 0: with margin 0 only atoms of the other type collide.
  Random random(1);
  const std::size_t n = 1000;
  ModelBuilder<Point> builder;
  std::vector<std::uint16_t> types;
  for (std::size_t k = 0; k < n; ++k) {
    builder.add_link(world, Prismatic{}, {Point{k % 10 == 0 ? random.vector(1.5) : Vec3(Vec3::Zero())}});
    types.push_back(k % 10 == 0 ? 1 : 0);
  }
  auto engines = atoms_on_three_engines(builder.finish(), {types, 2, {0.0, 0.0, 0.0, 0.5}});
  const std::vector<Hit> expected = engines.front().within(0.0, {});
  EXPECT_GT(expected.size(), 50U);
  for (AnyEngine<Point>& engine : engines) {
    SCOPED_TRACE(engine.name);
    QueryCounts counts;
    QueryOptions options;
    options.counts = &counts;
    EXPECT_EQ(engine.within(0.0, options), expected);
    if (engine.name == "lazy") {
      EXPECT_LT(counts.pairs_tested, n * n / 200);  // only the 100 atoms of type 1 are tested
    }
    EXPECT_EQ(engine.within(1e-3, {}).size(), engines.front().within(1e-3, {}).size());
  }
}

TEST(Atoms, NoneOneOrAllInOneGroupAreFreeAndHaveNoClosestPair) {
  ModelBuilder<Point> none, one, group;
  one.add_link(world, Revolute{}, {Point{}});
  group.add_link(world, Revolute{}, std::vector<Point>(1000));
  for (ModelBuilder<Point>* builder : {&none, &one, &group}) {
    const Model<Point> model = builder->finish();
    for (AnyEngine<Point>& engine : atoms_on_three_engines(model, one_type(model.size(), 1.0))) {
      SCOPED_TRACE(engine.name);
      EXPECT_FALSE(engine.collides({}));
      EXPECT_TRUE(engine.within(10.0, {}).empty());
      EXPECT_FALSE(engine.closest({}).has_value());
    }
  }
}

TEST(Atoms, EachItsOwnGroupEqualBruteForce) {
  Random random(2);
  std::vector<Vec3> points;
  for (int k = 0; k < 3000; ++k) points.push_back(random.vector(10.0));
  auto engines = atoms(points, 0.5);
  const std::vector<Hit> expected = engines.front().within(0.0, {});
  EXPECT_GT(expected.size(), 100U);
  for (AnyEngine<Point>& engine : engines) {
    EXPECT_EQ(engine.within(0.0, {}), expected) << engine.name;
    EXPECT_EQ(engine.closest({}), engines.front().closest({})) << engine.name;
  }
}

TEST(Atoms, CoincidentOnesAreAtDistanceZeroAndHit) {
  for (const double m : {5e-324, 1e-200, 1e-8, 1.0, 1e200}) {
    for (AnyEngine<Point>& engine : atoms(std::vector<Vec3>(40, Vec3(1e6, -3, 0.1)), m)) {
      const std::vector<Hit> hits = engine.within(0.0, {});
      ASSERT_EQ(hits.size(), 40U * 39U / 2U) << engine.name << " " << m;
      EXPECT_EQ(hits.front(), (Hit{PrimitiveId{0}, PrimitiveId{1}, 0.0, m}));
      EXPECT_EQ(engine.closest({}).value().gap(), -m);
    }
  }
}

TEST(Atoms, AtTheThresholdAreFreeAndOneUlpDecides) {
  const double up = std::numeric_limits<double>::infinity();
  // The distances are exact: 5, 7, 9 and 1, times a power of two.
  for (const Vec3& d : {Vec3(3, 4, 0), Vec3(2, 3, 6), Vec3(1, 4, 8), Vec3(0, 0, 1)})
    for (const int e : {-500, -40, 0, 40, 500}) {
      const double m = std::ldexp(std::sqrt(squared_norm(d)), e);
      const Vec3 apart(std::ldexp(d[0], e), std::ldexp(d[1], e), std::ldexp(d[2], e));
      const auto hit = [&](const Vec3& x, double threshold, bool expected) {
        for (AnyEngine<Point>& engine : atoms({Vec3::Zero(), x}, threshold))
          EXPECT_EQ(engine.collides({}), expected) << engine.name << " 2^" << e << " " << d.transpose();
      };
      hit(apart, m, false);
      hit(apart, std::nextafter(m, up), true);
      hit(apart, std::nextafter(m, 0.0), false);
      hit(Vec3(apart[0], apart[1], std::nextafter(apart[2], 0.0)), m, apart[2] > 0.0);
    }
}

__extension__ using Int128 = __int128;

/// Returns the exact verdict for coordinates in [1, 2) and a threshold in [0.5, 1): all are multiples of 2^-53.
bool truly_closer(const Vec3& a, const Vec3& b, double m) {
  const auto whole = [](double x) { return static_cast<Int128>(std::ldexp(x, 53)); };
  Int128 square = 0;
  for (int k = 0; k < 3; ++k) square += (whole(a[k]) - whole(b[k])) * (whole(a[k]) - whole(b[k]));
  return square < whole(m) * whole(m);
}

TEST(Atoms, AtDecimalTiesEqualTheExactAnswerOnTheStoredDoubles) {
  Random random(3);
  struct Tie {
    int x, y, z, m;  // in thousandths
  };
  const std::vector<Tie> ties = {{300, 400, 0, 500}, {360, 480, 0, 600},   {200, 300, 600, 700},
                                 {480, 640, 0, 800}, {100, 400, 800, 900}, {0, 0, 700, 700}};
  std::size_t closer = 0, ties_tried = 0;
  for (const Tie& tie : ties) {
    std::vector<Vec3> points;
    for (int k = 0; k < 100; ++k) {
      const auto draw = [&] { return 1000 + static_cast<int>(random.below(190)); };
      const int x = draw(), y = draw(), z = draw();
      points.emplace_back(x / 1000.0, y / 1000.0, z / 1000.0);
      points.emplace_back((x + tie.x) / 1000.0, (y + tie.y) / 1000.0, (z + tie.z) / 1000.0);
    }
    const double m = tie.m / 1000.0;
    std::vector<std::pair<std::size_t, std::size_t>> expected;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = i + 1; j < points.size(); ++j)
        if (truly_closer(points[i], points[j], m)) expected.emplace_back(i, j);
    for (std::size_t i = 0; i < points.size(); i += 2) closer += truly_closer(points[i], points[i + 1], m) ? 1U : 0U;
    ties_tried += points.size() / 2;
    for (AnyEngine<Point>& engine : atoms(points, m)) {
      std::vector<std::pair<std::size_t, std::size_t>> found;
      for (const Hit& hit : engine.within(0.0, {})) found.emplace_back(index(hit.first), index(hit.second));
      EXPECT_TRUE(found == expected) << engine.name << " " << m;
    }
  }
  EXPECT_GT(closer, ties_tried / 5);  // rounding puts ties on both sides of the threshold
  EXPECT_LT(closer, ties_tried * 4 / 5);
}

TEST(Atoms, OnALatticeAtTheThresholdAreFreeAndAllNeighboursHitOneUlpAbove) {
  const std::size_t side = test::exhaustive() ? 100 : 32;
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < side * side * side; ++k) {
    const std::size_t layer = k / side / side;
    points.emplace_back(1.25 * static_cast<double>(k % side), 1.25 * static_cast<double>(k / side % side),
                        1.25 * static_cast<double>(layer));
  }
  const Model<Point> model = own_groups(points);
  const std::size_t neighbours = 3 * side * side * (side - 1);
  const auto expect = [&](double m, std::size_t hits) {
    const auto engines = atoms_on_three_engines(model, one_type(points.size(), m));
    for (std::size_t e = 1; e < engines.size(); ++e) {
      EXPECT_EQ(engines[e].collides({}), hits > 0) << engines[e].name;
      EXPECT_EQ(engines[e].within(0.0, {}).size(), hits) << engines[e].name;
    }
  };
  expect(1.25, 0);
  expect(std::nextafter(1.25, 2.0), neighbours);
}

/// Translating integer coordinates or scaling by a power of two changes no answer if doubles hold the result exactly.
TEST(Atoms, FarAwayHugeTinyAndDenormalEqualTheExactAnswer) {
  Random random(4);
  std::vector<Vec3> base;
  for (int k = 0; k < 300; ++k)
    base.emplace_back(static_cast<double>(random.below(40)), static_cast<double>(random.below(40)),
                      static_cast<double>(random.below(40)));
  const double m = 5.0;  // integer coordinates give many ties
  const auto pairs = [](const std::vector<Hit>& hits) {
    std::vector<std::pair<PrimitiveId, PrimitiveId>> both;
    for (const Hit& hit : hits) both.emplace_back(hit.first, hit.second);
    return both;
  };
  std::vector<std::pair<PrimitiveId, PrimitiveId>> expected;
  for (std::size_t i = 0; i < base.size(); ++i)
    for (std::size_t j = i + 1; j < base.size(); ++j)
      if (squared_norm(Vec3(base[i] - base[j])) < m * m) expected.emplace_back(id<PrimitiveId>(i), id<PrimitiveId>(j));
  EXPECT_GT(expected.size(), 50U);
  const auto expect = [&](double scale, double offset) {
    std::vector<Vec3> points;
    for (const Vec3& x : base) points.emplace_back(x * scale + Vec3(offset, -offset, offset / 2));
    for (AnyEngine<Point>& engine : atoms(points, m * scale)) {
      SCOPED_TRACE(engine.name);
      SCOPED_TRACE(scale);
      SCOPED_TRACE(offset);
      EXPECT_EQ(pairs(engine.within(0.0, {})), expected);
    }
  };
  for (const double offset : {1e4, 1e6, 1e9, 1e11}) expect(1.0, offset);
  for (const int e : {-1070, -1030, -600, -500, -100, 100, 500, 600, 900}) expect(std::ldexp(1.0, e), 0.0);
}

}  // namespace atoms_test
}  // namespace hinge
