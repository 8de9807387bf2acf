// SPDX-License-Identifier: BSD-3-Clause
// Blocks of neighbouring configurations with one candidate list: results equal those of single queries, bit for bit.
#include "hinge/batch/state_batch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "engine/own_filters.hpp"
#include "engine/random_mechanism.hpp"
#include "hinge/detail/kinematics/forward_kinematics.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/primitive/sphere.hpp"

namespace hinge {
namespace state_batch_test {

using test::Random;

Model<Point> random_points(Random& random, std::size_t links, std::size_t per_link) {
  return test::random_model(random, links, per_link, false, [](Random& r, const Vec3& axis, const Vec3& point) {
    return Point{r.one_in(6) ? Vec3(point + axis * r.uniform(-2.0, 2.0)) : r.vector(3.0)};
  });
}

/// `count` configurations within `spread` of a random one; some values are many revolutions.
std::vector<double> neighbours(Random& random, std::size_t dof, std::size_t count, double spread) {
  std::vector<double> centre(dof), block;
  for (double& value : centre)
    value = random.uniform(-std::numbers::pi, std::numbers::pi) * (random.one_in(20) ? 1e7 : 1);
  for (std::size_t k = 0; k < count; ++k)
    for (const double value : centre) block.push_back(value + random.uniform(-spread, spread));
  return block;
}

TEST(FrameLanes, HaveTheBitsOfPoseSource) {
  Random random(5);
  for (int round = 0; round < 30; ++round) {
    const Model<Point> model = random_points(random, 60, 1);
    const DofSelection selection = test::random_selection(model.tree(), random);
    const auto groups = std::make_shared<const RigidGroups>(model.tree(), selection);
    const std::size_t dof = selection.size(), count = 1 + random.below(16);
    const std::vector<double> block = neighbours(random, dof, count, 3.0);
    detail::FrameLanes lanes(*groups);
    lanes.set(block, dof, [](GroupId) {});
    detail::ForwardKinematics single(groups, dof);
    for (std::size_t k = 0; k < detail::FrameLanes::size; ++k) {
      single.set_configuration(std::span(block).subspan(std::min(k, count - 1) * dof, dof));
      for (std::size_t g = 0; g < groups->size(); ++g)
        ASSERT_TRUE(lanes.pose(id<GroupId>(g), k) == single.pose(id<GroupId>(g))) << round << " " << k << " " << g;
    }
  }
}

struct Tally {
  std::size_t hits = 0, pairs = 0, states = 0;
};

/// Uses a filter that lists exclusions and excludes further pairs.
template <class P>
void compare(const Model<P>& model, Random& random, BatchCounts& total, Tally& tally) {
  const DofSelection selection = test::random_selection(model.tree(), random);
  const auto filter = test::own_filter<test::OwnOfList>(model, random);
  const TypedThresholds matrix = test::random_thresholds(model.size(), random);
  StateBatch<P, test::OwnOfList, TypedThresholds> batch(model, selection, filter, matrix);
  Hierarchy<P, test::OwnOfList, TypedThresholds, Brute> single(model, selection, filter, matrix);
  const std::size_t dof = selection.size();
  for (const double spread : {0.0, 1e-7, 1e-3, 0.02, 0.02, 0.2, 3.0, 0.01}) {
    const std::size_t count = dof == 0 ? 1 : 1 + random.below(16);
    std::vector<double> block = neighbours(random, dof, count, spread);
    for (int step = 0; step < 3; ++step) {  // steps of a walk, in which candidate lists are reused
      const detail::simd::Bits hit = batch.collides(block);
      std::vector<std::vector<Hit>> hits(count);
      batch.collisions(block, [&](std::size_t k, const Hit& h) { hits[k].push_back(h); });
      for (std::size_t k = 0; k < count; ++k) {
        single.update(std::span(block).subspan(k * dof, dof));
        const std::vector<Hit> expected = single.self_collisions();
        EXPECT_EQ((hit >> k & 1U) != 0, !expected.empty());
        EXPECT_EQ(hits[k], expected);
        tally.hits += expected.empty() ? 0 : 1;
        tally.pairs += expected.size();
        ++tally.states;
      }
      for (double& value : block) value += spread / 8;
    }
  }
  const BatchCounts& counts = batch.counts();
  total.in_lanes += counts.in_lanes;
  total.alone += counts.alone;
  total.lists += counts.lists;
  total.decided += counts.decided;
}

TEST(StateBatch, AnswersAsSingleQueriesDo) {
  constexpr std::uint64_t seed = 71;
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Random random(seed);
  BatchCounts points, spheres;
  Tally tally;
  const int rounds = std::getenv("HINGE_TEST_ALL") != nullptr ? 2000 : 60;
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE(round);
    compare(random_points(random, 12, 6), random, points, tally);
    compare(test::random_model(random, 12, 6, false,
                               [](Random& r, const Vec3& axis, const Vec3& point) {
                                 return Sphere{r.one_in(6) ? Vec3(point + axis * r.uniform(-2.0, 2.0)) : r.vector(3.0),
                                               r.uniform(0.0, 0.4)};
                               }),
            random, spheres, tally);
    if (HasFailure()) return;
  }
  std::printf("%zu states, %zu in collision, %zu pairs; points: %llu in lanes, %llu alone, %llu lists, %llu decided\n",
              tally.states, tally.hits, tally.pairs, static_cast<unsigned long long>(points.in_lanes),
              static_cast<unsigned long long>(points.alone), static_cast<unsigned long long>(points.lists),
              static_cast<unsigned long long>(points.decided));
  EXPECT_GT(points.in_lanes, 1000U);
  EXPECT_GT(spheres.in_lanes, 1000U);
  EXPECT_GT(tally.hits, 100U);
  EXPECT_LT(tally.hits, tally.states);
}

/// Links of two points each with alternating joint axes; one joint is prismatic. All lengths are multiples of `unit`.
Model<Point> chain_of(double unit, std::size_t links) {
  ModelBuilder<Point> builder;
  LinkId last = world;
  for (std::size_t l = 0; l < links; ++l) {
    Pose origin;
    origin.translation = Vec3(unit, 0, 0);
    Joint joint = Revolute{l % 2 == 0 ? Vec3::UnitZ() : Vec3(0.6, 0, 0.8), Vec3::Zero(), origin, {}};
    if (l == 1) joint = Prismatic{Vec3::UnitY(), origin, {}};
    last = builder.add_link(last, joint, {Point{Vec3(0, 0.3 * unit, 0)}, Point{Vec3(0.2 * unit, 0, 0.4 * unit)}});
  }
  return builder.finish();
}

TEST(StateBatch, AnswersAsSingleQueriesDoBetweenNeighbouringDoubles) {
  Random random(72);
  const Model<Point> model = chain_of(1.0, 14);
  const UniformClearance clearance(0.3);
  StateBatch<Point, AdmitAll, UniformClearance> batch(model, AdmitAll{}, clearance);
  Hierarchy<Point, AdmitAll, UniformClearance, Brute> single(model, AdmitAll{}, clearance);
  const std::size_t dof = batch.dof_count();
  std::vector<double> from(dof), to(dof), q(dof);
  const auto at = [&](double t) {
    for (std::size_t k = 0; k < dof; ++k) q[k] = from[k] + t * (to[k] - from[k]);
    single.update(q);
    return single.self_collides();
  };
  std::size_t both = 0;
  for (int round = 0; round < 2000; ++round) {
    for (std::size_t k = 0; k < dof; ++k) {
      from[k] = random.uniform(-2.0, 2.0);
      to[k] = random.uniform(-2.0, 2.0);
    }
    double low = 0.0, high = 1.0;
    const bool first = at(low);
    if (at(high) == first) continue;
    while (std::nextafter(low, 1.0) < high && high - low > 0x1p-52) {
      const double middle = 0.5 * (low + high);
      (at(middle) == first ? low : high) = middle;
    }
    std::vector<double> block;
    detail::simd::Bits expected = 0;
    for (std::size_t k = 0; k < 16; ++k) {
      expected |= (at(low + (static_cast<double>(k) - 7.0) * 0x1p-54) ? detail::simd::Bits{1} : 0) << k;
      block.insert(block.end(), q.begin(), q.end());
    }
    EXPECT_EQ(batch.collides(block), expected) << round;
    both += expected != 0 && expected != 0xffff ? 1U : 0U;
  }
  std::printf("%zu blocks hold both answers, %llu pairs decided in double\n", both,
              static_cast<unsigned long long>(batch.counts().decided));
  EXPECT_GT(both, 20U);
  EXPECT_GT(batch.counts().decided, 20U);
}

TEST(StateBatch, AnswersAsSingleQueriesDoAtAnySize) {
  Random random(73);
  for (const double unit : {1e-300, 1e-160, 1e-40, 1e-20, 1e-6, 1.0, 1e10, 1e30, 1e45, 1e200}) {
    SCOPED_TRACE(unit);
    const Model<Point> model = chain_of(unit, 7);
    const UniformClearance clearance(0.3 * unit);
    StateBatch<Point, AdmitAll, UniformClearance> batch(model, AdmitAll{}, clearance);
    Hierarchy<Point, AdmitAll, UniformClearance, Brute> single(model, AdmitAll{}, clearance);
    const std::size_t dof = batch.dof_count();
    for (int round = 0; round < 20; ++round) {
      std::vector<double> centre, block;
      for (std::size_t k = 0; k < dof; ++k) centre.push_back(random.uniform(-2.0, 2.0) * (k == 1 ? unit : 1.0));
      for (std::size_t k = 0; k < 16 * dof; ++k)
        block.push_back(centre[k % dof] + random.uniform(-0.01, 0.01) * (k % dof == 1 ? unit : 1.0));
      const detail::simd::Bits hit = batch.collides(block);
      for (std::size_t k = 0; k < 16; ++k) {
        single.update(std::span(block).subspan(k * dof, dof));
        EXPECT_EQ((hit >> k & 1U) != 0, single.self_collides()) << round << " " << k;
      }
    }
  }
}

TEST(StateBatch, RefusesWhatASingleQueryRefusesAndGoesOn) {
  const Model<Point> model = chain_of(1.0, 4);
  StateBatch<Point, AdmitAll, UniformClearance> batch(model, AdmitAll{}, UniformClearance(0.3));
  const std::vector<double> good(8, 0.1);
  const auto refusal = [&](const std::vector<double>& block) {
    try {
      batch.collides(block);
    } catch (const ConfigurationError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const detail::simd::Bits before = batch.collides(good);
  std::vector<double> bad = good;
  bad[6] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(bad), "configuration 1 of the block, value 2 is nan, expected a finite number");
  bad = good;
  bad[5] = 1e302;
  EXPECT_NE(refusal(bad).find("configuration 1 of the block, value 1 is"), std::string::npos);
  EXPECT_NE(refusal(bad).find("expected a displacement of at most 2^1000"), std::string::npos);
  EXPECT_EQ(refusal({}), "a block of 0 values, expected 1 to 16 configurations of 4 values");
  EXPECT_EQ(refusal(std::vector<double>(7)), "a block of 7 values, expected 1 to 16 configurations of 4 values");
  EXPECT_EQ(refusal(std::vector<double>(68)), "a block of 68 values, expected 1 to 16 configurations of 4 values");
  EXPECT_EQ(batch.collides(good), before);
}

}  // namespace state_batch_test
}  // namespace hinge
