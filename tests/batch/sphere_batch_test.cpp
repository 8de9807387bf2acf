// SPDX-License-Identifier: BSD-3-Clause
// Sphere models in SIMD lanes: each lane has the verdict of a single query, even where spheres touch within an ulp.
#include "hinge/batch/sphere_batch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "engine/own_filters.hpp"
#include "engine/random_mechanism.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/policy/different_links.hpp"

namespace hinge {
namespace sphere_batch_test {

using test::Random;

template <class F>
using Single = Hierarchy<Sphere, F, UniformClearance, Brute>;

struct Sizes {
  std::size_t links = 10, per_link = 5;
  double radius = 0.8;  ///< largest radius
  double unit = 1.0;    ///< factor of all lengths except those that random_model draws
};

Model<Sphere> random_spheres(Random& random, const Sizes& sizes) {
  return test::random_model(random, sizes.links, sizes.per_link, false,
                            [&](Random& r, const Vec3& axis, const Vec3& point) {
                              // One in eight is on the joint axis, so its distance across the joint cannot change.
                              const Vec3 on_axis = point + axis * r.uniform(-3.0, 3.0);
                              const Vec3 centre = r.one_in(8) ? on_axis : r.vector(2.0);
                              return Sphere{centre, r.one_in(9) ? 0.0 : r.uniform(0.0, sizes.radius)};
                            });
}

/// The same mechanism in another length unit, its base translated by `shift`.
Model<Sphere> moved(const Model<Sphere>& model, double unit, const Vec3& shift) {
  ModelBuilder<Sphere> builder;
  for (std::size_t l = 1; l < model.tree().link_count(); ++l) {
    Joint joint = model.tree().joint(id<LinkId>(l));
    const LinkId parent = model.tree().parent(id<LinkId>(l));
    joint.origin.translation *= unit;
    if (parent == world) joint.origin.translation += shift;
    joint.point *= unit;
    builder.add_link(parent, joint);
  }
  for (std::size_t i = 0; i < model.size(); ++i) {
    const Sphere& s = model.primitives()[i];
    const Vec3 at = s.center * unit + (model.links()[i] == world ? shift : Vec3::Zero());
    builder.add_primitive(model.links()[i], Sphere{at, s.radius * unit});
  }
  return builder.finish();
}

std::vector<double> random_block(const KinematicTree& tree, const DofSelection& selection, Random& random,
                                 std::size_t count, double slide) {
  std::vector<double> block;
  for (std::size_t k = 0; k < count; ++k)
    for (const DofId dof : selection.dofs()) {
      const bool slides = tree.joint(tree.link_of(dof)).kind == JointKind::prismatic;
      const double most = slides ? slide : std::numbers::pi;
      block.push_back(random.uniform(-most, most));
    }
  return block;
}

struct Tally {
  std::size_t lanes = 0, hits = 0, wrong = 0;
};

/// Compares both queries on one block with single queries.
template <class F>
void compare(SphereBatch& batch, Single<F>& single, std::span<const double> block, Tally& tally) {
  const std::size_t dof = batch.dof_count(), count = block.size() / dof;
  detail::simd::Bits expected = 0;
  for (std::size_t k = 0; k < count; ++k) {
    single.update(block.subspan(k * dof, dof));
    if (single.self_collides()) expected |= detail::simd::Bits{1} << k;
  }
  const detail::simd::Bits answer = batch.each(block);
  tally.lanes += count;
  tally.hits += static_cast<std::size_t>(std::popcount(expected));
  tally.wrong += static_cast<std::size_t>(std::popcount(answer ^ expected));
  EXPECT_EQ(batch.any(block), expected != 0);
}

TEST(SphereBatch, AnswersEveryLaneAsSingleQueriesDo) {
  Tally tally;
  std::uint64_t decided = 0;
  for (std::uint64_t seed = 1; seed <= 160; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Model<Sphere> model = random_spheres(random, {12, 4, random.one_in(2) ? 0.8 : 0.3});
    const DofSelection selection =
        random.one_in(2) ? DofSelection::all(model.tree()) : test::random_selection(model.tree(), random);
    if (selection.size() == 0) continue;
    const test::UnlistedPairs filter{test::ExcludedPairs(model.size(), random, 4)};
    SphereBatch batch(model, selection, filter);
    Single<test::UnlistedPairs> single(model, selection, filter, UniformClearance{0.0});
    for (int k = 0; k < 30; ++k) {
      const std::size_t count = random.one_in(4) ? 1 + random.below(SphereBatch::size) : SphereBatch::size;
      compare(batch, single, random_block(model.tree(), selection, random, count, 2.0), tally);
    }
    batch.learn(random_block(model.tree(), selection, random, 20, 2.0));
    for (int k = 0; k < 30; ++k)
      compare(batch, single, random_block(model.tree(), selection, random, SphereBatch::size, 2.0), tally);
    decided += batch.decided_count();
  }
  EXPECT_EQ(tally.wrong, 0U);
  EXPECT_GT(tally.lanes, 100'000U);
  EXPECT_GT(tally.hits, tally.lanes / 10);
  EXPECT_LT(tally.hits, tally.lanes - tally.lanes / 10);
  EXPECT_LT(decided, tally.lanes / 20) << "floats decide nearly everything";
  std::printf("%zu lanes, %zu hits, %llu decided in double\n", tally.lanes, tally.hits,
              static_cast<unsigned long long>(decided));
}

TEST(SphereBatch, AsksAFilterDerivedFromAStockOne) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const Model<Sphere> model = random_spheres(random, {12, 4, 0.8});
    const DofSelection selection = DofSelection::all(model.tree());
    if (selection.size() == 0) continue;
    const auto filter = test::own_filter<test::OwnWithLinks>(model, random);
    SphereBatch batch(model, filter);
    Single<test::OwnWithLinks> single(model, filter, UniformClearance{0.0});
    for (int k = 0; k < 10; ++k)
      compare(batch, single, random_block(model.tree(), selection, random, SphereBatch::size, 2.0), tally);
  }
  EXPECT_EQ(tally.wrong, 0U);
  EXPECT_GT(tally.hits, 0U);
  EXPECT_LT(tally.hits, tally.lanes);
}

/// Bisects between a and b, whose verdicts differ, down to adjacent doubles; returns configurations a few ulps
/// around.
template <class F>
std::vector<double> touching_block(Single<F>& single, std::vector<double> a, std::vector<double> b) {
  const auto verdict = [&](const std::vector<double>& q) {
    single.update(q);
    return single.self_collides();
  };
  const bool at_a = verdict(a);
  std::vector<double> middle(a.size());
  for (int k = 0; k < 80; ++k) {
    for (std::size_t d = 0; d < a.size(); ++d) middle[d] = a[d] + (b[d] - a[d]) / 2;
    (verdict(middle) == at_a ? a : b) = middle;
  }
  std::vector<double> block;
  for (int k = 0; k < 16; ++k) {
    std::vector<double> q = k % 2 == 0 ? a : b;
    for (int step = k / 4; step > 0; --step)
      for (double& value : q) value = std::nextafter(value, k % 2 == 0 ? 10.0 : -10.0);
    block.insert(block.end(), q.begin(), q.end());
  }
  return block;
}

struct Setting {
  double unit;
  double shift;
};

class SphereBatchAt : public testing::TestWithParam<Setting> {};

TEST_P(SphereBatchAt, AgreesWhereSpheresTouchWithinAnUlp) {
  const auto [unit, shift] = GetParam();
  Tally tally;
  std::uint64_t decided = 0;
  int touching = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Model<Sphere> drawn = random_spheres(random, {12, 4, 0.6});
    const Model<Sphere> model = moved(drawn, unit, Vec3::Constant(shift * unit));
    const DofSelection selection = DofSelection::all(model.tree());
    if (selection.size() == 0) continue;
    const DifferentLinks filter({model.links().begin(), model.links().end()});
    SphereBatch batch(model, filter);
    Single<DifferentLinks> single(model, filter, UniformClearance{0.0});
    for (int k = 0; k < 20; ++k) {
      const auto a = random_block(model.tree(), selection, random, 1, unit);
      const auto b = random_block(model.tree(), selection, random, 1, unit);
      single.update(a);
      const bool at_a = single.self_collides();
      single.update(b);
      if (single.self_collides() == at_a) continue;
      ++touching;
      compare(batch, single, touching_block(single, a, b), tally);
    }
    decided += batch.decided_count();
  }
  EXPECT_EQ(tally.wrong, 0U);
  EXPECT_GT(touching, 100);
  EXPECT_GE(decided, static_cast<std::uint64_t>(touching));
}

INSTANTIATE_TEST_SUITE_P(UnitsAndPlaces, SphereBatchAt,
                         testing::Values(Setting{1.0, 0.0}, Setting{1.0, 1e4}, Setting{1.0, 1e9}, Setting{1e-30, 0.0},
                                         Setting{0x1p-200, 1.0}, Setting{0x1p200, 1.0}),
                         [](const auto& at) { return "Setting" + std::to_string(at.index); });

TEST(SphereBatch, AgreesOnLongChains) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Random random(seed);
    ModelBuilder<Sphere> builder;
    LinkId link = world;
    for (int k = 0; k < 200; ++k) {
      Pose origin = random.pose(1.0);
      link = builder.add_link(link, Revolute{random.vector(1.0), random.vector(5.0), origin, {}},
                              {Sphere{random.vector(0.5), 0.2}});
    }
    const Model<Sphere> model = builder.finish();
    const DofSelection selection = DofSelection::all(model.tree());
    const DifferentLinks filter({model.links().begin(), model.links().end()});
    SphereBatch batch(model, filter);
    Single<DifferentLinks> single(model, filter, UniformClearance{0.0});
    for (int k = 0; k < 10; ++k) compare(batch, single, random_block(model.tree(), selection, random, 16, 1.0), tally);
  }
  EXPECT_EQ(tally.wrong, 0U);
  EXPECT_GT(tally.hits, 0U);
}

TEST(SphereBatch, AnswersHugeAnglesAndSlides) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Model<Sphere> model = random_spheres(random, {8, 3, 0.8});
    const DofSelection selection = DofSelection::all(model.tree());
    if (selection.size() == 0) continue;
    SphereBatch batch(model, AdmitAll{});
    Single<AdmitAll> single(model, AdmitAll{}, UniformClearance{0.0});
    for (const double size : {1e3, 1e7, 1e18, 1e150, 1e300, 1.0}) {
      std::vector<double> block = random_block(model.tree(), selection, random, 16, 1.0);
      for (double& value : block)
        if (random.one_in(5)) value *= size;
      compare(batch, single, block, tally);
    }
  }
  EXPECT_EQ(tally.wrong, 0U);
  EXPECT_GT(tally.hits, 0U);
}

/// A ball on a rotating arm, and a ball fixed to the world.
Model<Sphere> arm_and_obstacle() {
  ModelBuilder<Sphere> builder;
  builder.add_link(world, Revolute{}, {Sphere{{1, 0, 0}, 0.1}});
  builder.add_link(world, Fixed{}, {Sphere{{0, 1, 0}, 0.1}});
  return builder.finish();
}

TEST(SphereBatch, SetsTheBitOfTheConfigurationThatCollides) {
  SphereBatch batch(arm_and_obstacle(), AdmitAll{});
  const double there = std::numbers::pi / 2;
  EXPECT_EQ(batch.each({{0.0, there, 0.3, there}}), 0b1010U);
  EXPECT_EQ(batch.each({{there}}), 1U);
  EXPECT_TRUE(batch.any({{0.0, there}}));
  EXPECT_FALSE(batch.any({{0.0, 0.1, 3.0}}));
  EXPECT_EQ(batch.pair_count(), 1U);
}

TEST(SphereBatch, RefusesBlocksOfAnotherLengthAndValuesThatAreNotFinite) {
  SphereBatch batch(arm_and_obstacle(), AdmitAll{});
  EXPECT_THROW(batch.any({}), ConfigurationError);
  EXPECT_THROW(batch.each(std::vector<double>(17, 0.0)), ConfigurationError);
  EXPECT_THROW(batch.each({{0.0, std::numeric_limits<double>::quiet_NaN()}}), ConfigurationError);
  EXPECT_THROW(batch.learn({{std::numeric_limits<double>::infinity()}}), ConfigurationError);
  EXPECT_EQ(batch.each(std::vector<double>(16, std::numbers::pi / 2)), 0xffffU);
}

TEST(SphereBatch, RefusesFilterOfAnotherModel) {
  EXPECT_THROW(SphereBatch(arm_and_obstacle(), DifferentLinks({LinkId{1}})), ModelError);
}

TEST(SphereBatch, MayBeCopied) {
  SphereBatch batch(arm_and_obstacle(), AdmitAll{});
  SphereBatch other = batch;
  EXPECT_TRUE(other.any({{std::numbers::pi / 2}}));
  EXPECT_FALSE(batch.any({{0.0}}));
}

}  // namespace sphere_batch_test
}  // namespace hinge
