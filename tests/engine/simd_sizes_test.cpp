// SPDX-License-Identifier: BSD-3-Clause
// engine/simd against brute force on points, for sizes around every boundary of blocks, rows of boxes and trees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "engine/sized_models.hpp"
#include "hinge/detail/engine/simd/block_layout.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge {
namespace simd_sizes_test {

using test::ExcludedPairs;
using test::GroupSizes;
using test::Random;
using test::UnlistedPairs;

/// A distance of points has the same bits in both directions, so hits must be equal, not only close.
void expect_equal(const std::vector<Hit>& tested, const std::vector<Hit>& reference) {
  ASSERT_EQ(tested.size(), reference.size());
  for (std::size_t k = 0; k < tested.size(); ++k)
    ASSERT_EQ(tested[k], reference[k]) << "hit " << k << ": " << index(tested[k].first) << ' '
                                       << index(tested[k].second) << " or " << index(reference[k].first) << ' '
                                       << index(reference[k].second);
}

/// If several pairs are equally close, either engine may return any of them.
void expect_equal(const std::optional<Hit>& tested, const std::optional<Hit>& reference) {
  ASSERT_EQ(tested.has_value(), reference.has_value());
  if (tested) {
    ASSERT_EQ(tested->gap(), reference->gap());
  }
}

/// A filter between two models, without any symmetry in i and j.
struct Checkered {
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept { return (7 * index(i) + 3 * index(j)) % 5 != 0; }
};
AdmitAll across(const AdmitAll&) { return {}; }
template <class F>
Checkered across(const F&) {
  return {};
}

/// One model in both engines.
template <class F, class D>
struct Both {
  Both(const Model<Point>& model, const DofSelection& selection, const F& f, const D& matrix)
      : tested(model, selection, f, matrix), reference(model, selection, f, matrix), filter(f) {}

  template <class Action>
  void both(const Action& action) {
    action(tested);
    action(reference);
  }
  std::vector<double> clearance(Random& random) const {
    std::vector<double> extra(tested.model().groups()->size());
    for (double& value : extra) value = random.one_in(2) ? 0.0 : random.uniform(0.0, 0.6);
    return extra;
  }

  Hierarchy<Point, F, D, Simd> tested;
  Hierarchy<Point, F, D, Brute> reference;
  F filter;
};

struct Tally {
  std::size_t states = 0, colliding = 0, free = 0;
};

template <class F, class D>
void compare_self(Both<F, D>& model, Random& random, Tally& tally) {
  QueryOptions options;
  std::vector<double> clearance;
  if (random.one_in(3)) clearance = model.clearance(random);
  options.clearance = clearance;
  options.moved_only = random.one_in(3);
  const auto all = model.reference.self_collisions(options);
  expect_equal(model.tested.self_collisions(options), all);
  EXPECT_EQ(model.tested.self_collides(options), !all.empty());
  expect_equal(model.tested.self_within(0.5, options), model.reference.self_within(0.5, options));
  const auto closest = model.reference.self_closest(options);
  expect_equal(model.tested.self_closest(options), closest);
  expect_equal(model.tested.self_closest(options), closest);  // starts from the previous answer
  ++tally.states;
  ++(all.empty() ? tally.free : tally.colliding);
}

template <class F, class D>
void compare_across(Both<F, D>& a, Both<F, D>& b, Random& random) {
  QueryOptions options;
  std::vector<double> mine, theirs;
  if (random.one_in(3)) mine = a.clearance(random);
  if (random.one_in(3)) theirs = b.clearance(random);
  options.clearance = mine;
  options.other_clearance = theirs;
  options.moved_only = random.one_in(3);
  const auto filter = across(a.filter);
  const auto all = a.reference.collisions(b.reference, filter, options);
  expect_equal(a.tested.collisions(b.tested, filter, options), all);
  EXPECT_EQ(a.tested.collides(b.tested, filter, options), !all.empty());
  expect_equal(a.tested.within(b.tested, 0.5, filter, options), a.reference.within(b.reference, 0.5, filter, options));
  expect_equal(a.tested.closest(b.tested, filter, options), a.reference.closest(b.reference, filter, options));
}

/// Compares both engines in `states` states, set through every kind of update.
template <class F, class D>
void walk(Both<F, D>& a, Both<F, D>& b, int states, Random& random, Tally& tally) {
  std::vector<double> q(a.tested.dof_count()), other(b.tested.dof_count());
  for (double& value : other) value = random.uniform(-3.0, 3.0);
  b.both([&](auto& h) { h.update(other); });
  for (int state = 0; state < states; ++state) {
    SCOPED_TRACE(state);
    switch (state % 6) {
      case 0:  // all groups move
        for (double& value : q) value = random.uniform(-3.0, 3.0);
        a.both([&](auto& h) { h.update(q); });
        break;
      case 1:  // few groups move
      case 4:
        for (std::size_t k = 0; k < 1 + q.size() / 20 && !q.empty(); ++k)
          q[random.below(q.size())] = random.uniform(-3.0, 3.0);
        a.both([&](auto& h) { h.update(q); });
        break;
      case 2:  // each primitive moves on its own
      {
        std::vector<Point> placed(a.reference.placed().begin(), a.reference.placed().end());
        for (Point& p : placed) p.position += random.vector(0.3);
        a.both([&](auto& h) { h.update_placed(placed); });
        break;
      }
      case 3: a.both([&](auto& h) { h.update(q); }); break;
      default: {
        std::vector<Pose> poses(a.tested.model().groups()->size());
        for (std::size_t g = 1; g < poses.size(); ++g) poses[g] = random.pose(2.0);
        a.both([&](auto& h) { h.update_poses(poses); });
      }
    }
    compare_self(a, random, tally);
    if (state % 2 == 0)
      compare_across(a, b, random);
    else
      compare_across(b, a, random);
    if (testing::Test::HasFailure()) return;
  }
}

enum class Matrix : std::uint8_t { uniform, few_types, many_types, zeros };
enum class Filter : std::uint8_t { none, listed, unlisted };
constexpr std::size_t matrices = 4, filters = 3;

struct Case {
  std::vector<std::size_t> links, other_links;  ///< number of primitives per link of the two models
  Matrix matrix = Matrix::uniform;
  Filter filter = Filter::none;
  int states = 4;
};

Tally run(const Case& c, Random& random) {
  Tally tally;
  const Model<Point> a = test::sized_model(c.links, random), b = test::sized_model(c.other_links, random);
  const DofSelection all = DofSelection::all(a.tree()), some = test::random_selection(b.tree(), random);
  const auto with_both = [&](const auto& filter_a, const auto& filter_b) {
    const auto with = [&](const auto& matrix_a, const auto& matrix_b) {
      Both mine(a, all, filter_a, matrix_a);
      Both theirs(b, some, filter_b, matrix_b);
      walk(mine, theirs, c.states, random, tally);
    };
    if (c.matrix == Matrix::uniform) {
      const UniformClearance clearance(random.one_in(4) ? 0.0 : random.uniform(0.0, 1.2));
      return with(clearance, clearance);
    }
    const std::size_t types = c.matrix == Matrix::many_types ? 17 + random.below(40) : 1 + random.below(16);
    auto table = test::random_table(types, c.matrix == Matrix::zeros ? 10 : random.below(5), random);
    // Every second table contains a type that never collides.
    const bool has_idle_type = types > 1 && random.one_in(2);
    for (std::size_t t = 0; t < types && has_idle_type; ++t) table[t] = table[t * types] = 0.0;
    with(test::dealt_thresholds(a.size(), types, table, random),
         test::dealt_thresholds(b.size(), types, table, random));
  };
  // Excludes about four partners per primitive in large models, one pair in five in small ones.
  const auto excluded = [&](const Model<Point>& m) {
    return ExcludedPairs(m.size(), random, std::max<std::size_t>(5, m.size() / 4));
  };
  if (c.filter == Filter::none) {
    with_both(AdmitAll{}, AdmitAll{});
  } else {
    const ExcludedPairs first = excluded(a), second = excluded(b);
    if (c.filter == Filter::listed)
      with_both(first, second);
    else
      with_both(UnlistedPairs{first}, UnlistedPairs{second});
  }
  return tally;
}

/// Runs each size with every distribution over rigid groups and with `combinations` of the twelve combinations of
/// matrix and filter.
void run_sizes(std::span<const std::size_t> sizes, std::size_t combinations, int states, std::uint64_t seed) {
  Random random(seed);
  Tally total;
  for (std::size_t s = 0; s < sizes.size(); ++s)
    for (std::size_t g = 0; g < test::all_group_sizes.size(); ++g)
      for (std::size_t k = 0; k < combinations; ++k) {
        const std::size_t n = sizes[s], matrix = (k + g + s) % matrices, filter = (k / matrices + g + s) % filters;
        Case c;
        c.links = test::share_out(n, test::all_group_sizes[g], random);
        constexpr std::size_t other[] = {0, 1, 16, 17, 33, 300};
        c.other_links = test::share_out(other[random.below(std::size(other))],
                                        test::all_group_sizes[random.below(test::all_group_sizes.size())], random);
        c.matrix = static_cast<Matrix>(matrix);
        c.filter = static_cast<Filter>(filter);
        c.states = states;
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << n << " points, group sizes " << g << ", matrix "
                                        << matrix << ", filter " << filter);
        const Tally tally = run(c, random);
        total.states += tally.states;
        total.colliding += tally.colliding;
        total.free += tally.free;
        if (testing::Test::HasFailure()) return;
      }
  // Both answers must be frequent, or the comparison proves little.
  EXPECT_GT(total.colliding, total.states / 10);
  EXPECT_GT(total.free, total.states / 50);
}

TEST(SimdSizes, EqualsBruteUpToThirtyThreePoints) {
  constexpr std::size_t sizes[] = {0, 1, 2, 3, 15, 16, 17, 31, 32, 33};
  run_sizes(sizes, matrices * filters, 6, 1);
}

TEST(SimdSizes, EqualsBruteAroundTwoHundredFiftySix) {
  constexpr std::size_t sizes[] = {255, 256, 257};
  run_sizes(sizes, matrices * filters, 6, 2);
}

/// Brute force takes seconds on a large model, so `./run test` skips some cases that `./run test --all` runs.
bool exhaustive() { return std::getenv("HINGE_TEST_ALL") != nullptr; }

TEST(SimdSizes, EqualsBruteOnLargeModels) {
  constexpr std::size_t sizes[] = {1000, 2000, 5000};
  run_sizes(std::span(sizes).first(exhaustive() ? 3 : 2), 1, 3, 3);
}

/// Group sizes: small, one row of blocks, the largest without a tree, and 4097 points, which need three levels of
/// boxes.
TEST(SimdSizes, EqualsBruteWhereGroupsHaveTrees) {
  constexpr std::size_t row = detail::simd::width * detail::simd::width,
                        flat = detail::BlockLayout::largest_flat_group * detail::simd::width;
  Random random(4);
  std::size_t turn = 0;
  for (const std::vector<std::size_t>& links : {std::vector<std::size_t>{0, row + 1},
                                                {0, row + 1, 1, 2},
                                                {3, 300, 16, 0, 1},
                                                {300, 5, row + 1, row},
                                                {0, flat, 7, 1},
                                                {0, 1, flat + 1, 9, 17},
                                                {flat + 1, 2, flat + 1},
                                                {0, 4097, 3, 20},
                                                {4097, 2, 1},
                                                {1, 300, 4097}})
    for (const std::vector<std::size_t>& other : {std::vector<std::size_t>{0, 5}, {0, flat + 1, 3}}) {
      const bool large = *std::max_element(links.begin(), links.end()) > 1000;
      if (!exhaustive() && large && other.size() == 2) continue;
      Case c{links, other, static_cast<Matrix>(turn % matrices), static_cast<Filter>(turn / 2 % filters),
             large && !exhaustive() ? 1 : 2};
      SCOPED_TRACE(testing::Message() << "seed 4, case " << turn);
      if (links[0] + links[1] < 1000) c.states = 6;
      run(c, random);
      ++turn;
      if (testing::Test::HasFailure()) return;
    }
}

/// A rotated and translated lattice. Neighbours are one clearance apart up to the last bits of a double, so floats
/// alone would misjudge half of the pairs.
TEST(SimdSizes, LosesNoPairAtItsThreshold) {
  Random random(5);
  std::size_t hits = 0, misses = 0;
  for (const GroupSizes groups : test::all_group_sizes)
    for (const double far : {0.0, 1.0, 300.0, 1e5}) {
      SCOPED_TRACE(testing::Message() << "seed 5, group sizes " << static_cast<int>(groups) << ", " << far << " away");
      const Pose lattice{random.pose(1.0).rotation, random.vector(far)};
      ModelBuilder<Point> builder;
      LinkId link = world;
      std::size_t placed = 0;
      for (const std::size_t size : test::share_out(343, groups, random)) {
        if (placed > 0 || size == 0) link = builder.add_link(link, Revolute{Vec3::UnitZ(), random.vector(far), {}, {}});
        for (std::size_t k = 0; k < size; ++k, ++placed) {
          const std::size_t layer = placed / 49;
          const Vec3 cell(static_cast<double>(placed % 7), static_cast<double>(placed / 7 % 7),
                          static_cast<double>(layer));
          builder.add_primitive(link, Point{lattice * cell});
        }
      }
      const auto model = builder.finish();
      const DofSelection all = DofSelection::all(model.tree());
      for (const double off : {-1e-9, 0.0, 1e-9}) {
        const UniformClearance clearance(1.0 + off * (1e-3 + far));
        Both both(model, all, AdmitAll{}, clearance);
        // A joint angle of 1e-17 changes only the last bits.
        const std::vector<double> q(both.tested.dof_count(), random.one_in(2) ? 0.0 : 1e-17);
        both.both([&](auto& h) { h.update(q); });
        const auto expected = both.reference.self_collisions();
        expect_equal(both.tested.self_collisions(), expected);
        expect_equal(both.tested.self_closest(), both.reference.self_closest());
        Both same(model, all, AdmitAll{}, clearance);
        expect_equal(both.tested.collisions(same.tested), both.reference.collisions(same.reference));
        hits += expected.size();
        misses += both.reference.self_within(1e-6 * (1.0 + far)).size() - expected.size();
        if (testing::Test::HasFailure()) return;
      }
    }
  EXPECT_GT(hits, 1000U);
  EXPECT_GT(misses, 1000U);
}

/// Exponentially spaced points, which floats cannot separate. Queries switch to the double-precision BVH in the
/// middle of rigid groups, of chains, and of pairs of models.
TEST(SimdSizes, EqualsBruteWhereFloatsTellNothingApart) {
  Random random(6);
  const auto point = [&] { return Point{std::exp2(random.uniform(-20.0, 900.0)) * random.vector(1.0)}; };
  const auto model_of = [&](const std::vector<std::size_t>& per_link) {
    ModelBuilder<Point> builder;
    for (const std::size_t size : per_link) {
      const LinkId link = builder.add_link(world, Prismatic{Vec3::UnitX(), {}, {}});
      for (std::size_t k = 0; k < size; ++k) builder.add_primitive(link, point());
    }
    return builder.finish();
  };
  const Model<Point> groups = model_of({700, 5, 700, 300}), own = model_of(std::vector<std::size_t>(1000, 1));
  const ExcludedPairs first(groups.size(), random, 400), second(own.size(), random, 400);
  const UniformClearance clearance(0.3);
  Both a(groups, DofSelection::all(groups.tree()), first, clearance);
  Both b(own, DofSelection::all(own.tree()), second, clearance);
  Tally tally;
  walk(a, b, 4, random, tally);
  walk(b, a, 4, random, tally);
  QueryCounts counts;
  QueryOptions options;
  options.counts = &counts;
  a.tested.self_collisions(options);
  b.tested.self_collisions(options);
  a.tested.collisions(b.tested, across(first), options);
  EXPECT_GT(counts.nodes_split, 0U);
}

/// n points at one position, each on its own slider along x.
Model<Point> crowd_at_one_point(std::size_t n) {
  ModelBuilder<Point> builder;
  for (std::size_t k = 0; k < n; ++k) builder.add_link(world, Prismatic{Vec3::UnitX(), {}, {}}, {Point{Vec3(1, 2, 3)}});
  return builder.finish();
}

TEST(SimdSizes, PassesOverTypesWithoutThresholdsBetweenModels) {
  const std::size_t n = 20'000;
  std::vector<std::uint16_t> types(n, 0);
  types[5] = types[n / 2] = 1;
  const TypedThresholds matrix(types, 2, {0.0, 0.0, 0.0, 1.0});
  using Crowd = Hierarchy<Point, AdmitAll, TypedThresholds, Simd>;
  const auto model = crowd_at_one_point(n);
  Crowd a(model, AdmitAll{}, matrix), b(model, AdmitAll{}, matrix);
  QueryCounts counts;
  QueryOptions options;
  options.counts = &counts;
  EXPECT_EQ(a.collisions(b, AdmitAll{}, options).size(), 4U);
  EXPECT_LE(counts.pairs_tested + counts.boxes_tested, 16 * detail::simd::width);
}

}  // namespace simd_sizes_test
}  // namespace hinge
