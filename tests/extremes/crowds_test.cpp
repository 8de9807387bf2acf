// SPDX-License-Identifier: BSD-3-Clause
// Tests many atoms where boxes prune little: at one point, within one diameter, on a line, with exponential spacing.
// Depth, stack and work are bounded; sampled answers equal brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "extremes/stack_used.hpp"
#include "extremes/three_engines.hpp"

namespace hinge {
namespace crowds_test {

using test::AnyEngine;
using test::one_type;
using test::own_groups;
using test::Random;

std::size_t crowd() { return test::exhaustive() ? 1000000 : 100000; }

std::vector<Vec3> at_one_point(std::size_t n) { return std::vector<Vec3>(n, Vec3(1, 2, 3)); }
std::vector<Vec3> in_one_diameter(std::size_t n) {
  Random random(1);
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < n; ++k) points.push_back(random.vector(1.5));
  return points;
}
std::vector<Vec3> on_a_line(std::size_t n) {
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < n; ++k) points.emplace_back(0.1 * static_cast<double>(k), 0, 0);
  return points;
}
std::vector<Vec3> exponentially_spaced(std::size_t n) {
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < n; ++k)
    points.emplace_back(std::exp2(1000.0 * static_cast<double>(k) / static_cast<double>(n) - 500.0), 0, 0);
  return points;
}

/// Expects a bounded depth of the tree over the atoms' boxes, fully split.
void expect_bounded_depth(const std::vector<Vec3>& points) {
  std::vector<Aabb> boxes;
  for (const Vec3& x : points) boxes.push_back(Aabb(x).inflated(0.5));
  detail::LazyTree tree;
  tree.reset(boxes);
  std::uint32_t depth = 0;
  for (std::uint32_t k = 0; k < tree.node_count(); ++k) {
    depth = std::max(depth, tree.node(k).depth);
    if (!tree.node(k).is_leaf()) tree.split(k);
  }
  EXPECT_LE(depth, 3 * std::bit_width(points.size() - 1) + 9);
}

struct Answer {
  bool collides = false;
  std::vector<Hit> hits;
  QueryCounts counts;
};

/// Builds the model and an engine, runs the query, and measures its stack.
template <class Ask>
Answer ask(const std::vector<Vec3>& points, double m, const std::string& name, const Ask& ask_engine) {
  Answer answer;
  const auto start = std::chrono::steady_clock::now();
  const std::size_t used = test::stack_used([&] {
    auto engines = test::atoms_on_three_engines(own_groups(points), one_type(points.size(), m));
    QueryOptions options;
    options.counts = &answer.counts;
    for (AnyEngine<Point>& engine : engines)
      if (engine.name == name) ask_engine(engine, options, answer);
  });
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::cout << name << ", " << points.size() << " atoms: " << time.count() << " s, " << used << " bytes of stack, "
            << answer.counts.boxes_tested << " box tests, " << answer.counts.pairs_tested << " pair tests\n";
  if (!test::stack_is_padded) {
    EXPECT_LT(used, test::stack_limit);
  }
  return answer;
}
Answer ask_yes_or_no(const std::vector<Vec3>& points, double m, const std::string& name) {
  return ask(points, m, name, [](AnyEngine<Point>& engine, const QueryOptions& options, Answer& answer) {
    answer.collides = engine.collides(options);
  });
}
Answer ask_all(const std::vector<Vec3>& points, double m, const std::string& name) {
  return ask(points, m, name, [](AnyEngine<Point>& engine, const QueryOptions& options, Answer& answer) {
    answer.hits = engine.within(0.0, options);
  });
}

/// Expects the hits of 50 atoms to equal those of brute force.
void expect_sampled(const std::vector<Hit>& hits, const std::vector<Vec3>& points, double m) {
  const std::size_t samples = 50;
  for (std::size_t s = 0; s < samples; ++s) {
    const std::size_t i = s * points.size() / samples;
    std::size_t expected = 0;
    for (std::size_t j = 0; j < points.size(); ++j)
      if (j != i && closer_than(Point{points[i]}, Point{points[j]}, m)) ++expected;
    const auto found = std::count_if(hits.begin(), hits.end(),
                                     [i](const Hit& hit) { return index(hit.first) == i || index(hit.second) == i; });
    ASSERT_EQ(static_cast<std::size_t>(found), expected) << "atom " << i;
  }
}

/// Expects at most ten times the work for eight times the atoms: n log n from 12500 to 100000 is a factor of 9.8.
void expect_n_log_n(const QueryCounts& eighth, const QueryCounts& whole) {
  EXPECT_LE(whole.boxes_tested, 10 * eighth.boxes_tested);
  EXPECT_LE(whole.nodes_split, 10 * eighth.nodes_split);
  EXPECT_LE(whole.pairs_tested, 10 * eighth.pairs_tested);
}

TEST(Crowds, AtOnePointHit) {
  expect_bounded_depth(at_one_point(crowd()));
  for (const char* engine : {"lazy", "simd"}) {
    const Answer answer = ask_yes_or_no(at_one_point(crowd()), 3.0, engine);
    EXPECT_TRUE(answer.collides);
    EXPECT_LT(answer.counts.pairs_tested, 1000U);
  }
}

TEST(Crowds, AtOnePointWithThresholdsOfZeroAreFreeAndCostNothing) {
  for (const char* engine : {"lazy", "simd"}) {
    const Answer answer = ask_yes_or_no(at_one_point(crowd()), 0.0, engine);
    EXPECT_FALSE(answer.collides);
    EXPECT_EQ(answer.counts.pairs_tested + answer.counts.boxes_tested, 0U);
  }
}

TEST(Crowds, AtOnePointWithAnotherTypeAmongThemCostNoMoreThanThat) {
  const std::size_t n = crowd();
  std::vector<std::uint16_t> types(n, 0);
  for (const std::size_t i : {std::size_t{7}, n / 3, n - 1}) types[i] = 1;
  const TypedThresholds matrix(types, 2, {0.0, 0.0, 0.0, 3.0});
  for (AnyEngine<Point>& engine : test::atoms_on_three_engines(own_groups(at_one_point(n)), matrix)) {
    if (engine.name == "brute") continue;
    QueryCounts counts;
    QueryOptions options;
    options.counts = &counts;
    EXPECT_EQ(engine.within(0.0, options).size(), 3U);
    EXPECT_TRUE(engine.collides(options));
    // Given coordinates replace those of the configuration; the work stays bounded.
    engine.update_placed(std::vector<Point>(n, Point{Vec3(4, 5, 6)}));
    EXPECT_EQ(engine.within(0.0, options).size(), 3U);
    EXPECT_LE(counts.pairs_tested + counts.boxes_tested, 1000U) << engine.name;
  }
}

/// Returns a model of two rigid groups, each on its own prismatic joint.
Model<Point> two_groups(const std::vector<Vec3>& first, const std::vector<Vec3>& second) {
  ModelBuilder<Point> builder;
  for (const auto* points : {&first, &second}) {
    std::vector<Point> group;
    for (const Vec3& x : *points) group.push_back(Point{x});
    builder.add_link(world, Prismatic{Vec3::UnitX(), {}, {}}, group);
  }
  return builder.finish();
}

/// The first tested pair bounds the search. When all points coincide, no pair is closer than it.
TEST(Crowds, ClosestOfTwoLargeGroupsLooksAtFewPairs) {
  const std::size_t n = crowd() / 4;
  // The largest threshold belongs to a third type that no atom has.
  std::vector<std::uint16_t> types(2 * n, 0);
  types[n / 2] = 1;
  const TypedThresholds matrix(types, 3, {3.0, 2.0, 3.5, 2.0, 2.0, 3.5, 3.5, 3.5, 3.5});
  Random random(6);
  std::vector<Vec3> cloud, other;
  for (std::size_t k = 0; k < n; ++k) cloud.push_back(random.vector(std::cbrt(static_cast<double>(n))));
  for (std::size_t k = 0; k < n; ++k) other.push_back(random.vector(std::cbrt(static_cast<double>(n))));
  for (const bool coincide : {true, false}) {
    const Model<Point> model = coincide ? two_groups(at_one_point(n), at_one_point(n)) : two_groups(cloud, other);
    std::vector<double> gaps;
    for (AnyEngine<Point>& engine : test::atoms_on_three_engines(model, matrix)) {
      if (engine.name == "brute") continue;
      QueryCounts counts;
      QueryOptions options;
      options.counts = &counts;
      const auto closest = engine.closest(options);
      ASSERT_TRUE(closest.has_value());
      gaps.push_back(closest->gap());
      EXPECT_LE(counts.pairs_tested + counts.boxes_tested, 100 * n) << engine.name;
    }
    EXPECT_EQ(gaps[0], gaps[1]);
    if (coincide) {
      EXPECT_EQ(gaps[0], -3.0);
    }
  }
}

/// Two rigid groups with coordinates outside the range of floats: the float filter prunes nothing, so the search in a
/// group's tree stops early.
TEST(Crowds, ExponentiallySpacedInTwoGroupsEqualOnBothEngines) {
  const std::size_t n = crowd() / 4;
  const double m = std::exp2(-495.0);
  std::vector<std::vector<Hit>> hits;
  for (AnyEngine<Point>& engine :
       test::atoms_on_three_engines(two_groups(exponentially_spaced(n), exponentially_spaced(n)), one_type(2 * n, m))) {
    if (engine.name == "brute") continue;
    QueryCounts counts;
    QueryOptions options;
    options.counts = &counts;
    hits.push_back(engine.within(0.0, options));
    EXPECT_LE(counts.pairs_tested + counts.boxes_tested, 100 * n + 10 * hits.back().size()) << engine.name;
  }
  EXPECT_GT(hits[0].size(), n);
  EXPECT_EQ(hits[1], hits[0]);
}

TEST(Crowds, InOneDiameterEqualBruteForce) {
  const std::vector<Vec3> points = in_one_diameter(crowd());
  expect_bounded_depth(points);
  for (const char* engine : {"lazy", "simd"}) EXPECT_TRUE(ask_yes_or_no(points, 3.0, engine).collides);
  const double m = 0.02;
  const Answer lazy = ask_all(points, m, "lazy");
  expect_sampled(lazy.hits, points, m);
  const std::vector<Vec3> eighth = in_one_diameter(crowd() / 8);
  expect_n_log_n(ask_all(eighth, 2 * m, "lazy").counts, lazy.counts);
  // Blocks of the SIMD engine follow the order of links. Here consecutive atoms are far apart, so each block's box is
  // as large as the whole.
  const Answer simd = ask_all(points, m, "simd");
  EXPECT_EQ(simd.hits, lazy.hits);
  expect_n_log_n(ask_all(eighth, 2 * m, "simd").counts, simd.counts);
}

TEST(Crowds, OnALineEqualBruteForce) {
  const std::vector<Vec3> points = on_a_line(crowd());
  expect_bounded_depth(points);
  const double m = 0.15;
  for (const char* engine : {"lazy", "simd"}) {
    const Answer answer = ask_all(points, m, engine);
    EXPECT_EQ(answer.hits.size(), points.size() - 1);
    expect_sampled(answer.hits, points, m);
    if (engine == std::string("lazy")) expect_n_log_n(ask_all(on_a_line(crowd() / 8), m, engine).counts, answer.counts);
  }
}

TEST(Crowds, ExponentiallySpacedEqualBruteForce) {
  const std::vector<Vec3> points = exponentially_spaced(crowd());
  expect_bounded_depth(points);
  const double m = std::exp2(-495.0);
  const Answer lazy = ask_all(points, m, "lazy");
  EXPECT_GT(lazy.hits.size(), 1000U);
  expect_sampled(lazy.hits, points, m);
  // In float nearly all points coincide.
  const Answer simd = ask_all(points, m, "simd");
  EXPECT_EQ(simd.hits, lazy.hits);
  // Each hit may cost one candidate, which counts sixteen pairs.
  EXPECT_LE(simd.counts.pairs_tested + simd.counts.boxes_tested, 100 * points.size() + 16 * simd.hits.size());
}

/// All joints have the same axis and all atoms are on it, so they are fixed in the frame of every link.
TEST(Crowds, OnTheAxesOfALongChainStayConstantInBoundedMemory) {
  for (const bool star : {false, true}) {
    ModelBuilder<Point> builder;
    LinkId parent = world;
    const std::size_t n = star ? crowd() : test::exhaustive() ? 3000 : 1000;
    for (std::size_t k = 0; k < n; ++k) {
      const double z = static_cast<double>(k);
      const LinkId link = builder.add_link(parent, Revolute{}, {Point{Vec3(0, 0, z)}});
      if (!star) parent = link;
    }
    builder.add_link(parent, Revolute{Vec3::UnitX(), Vec3::Zero(), {}, {}},
                     {Point{Vec3(1, 0, 0)}, Point{Vec3(0, 1, 0)}});
    const Model<Point> built = builder.finish();
    const SelectedModel<Point> model(built, DofSelection::all(built.tree()));
    Random random(5);
    const auto last = id<PrimitiveId>(n);
    for (int k = 0; k < 100; ++k) {
      const auto i = id<PrimitiveId>(random.below(n)), j = id<PrimitiveId>(random.below(n));
      EXPECT_TRUE(model.constant(i, j));
      EXPECT_TRUE(
          model.constant(last, i));  // is on the x axis, so it is fixed in a frame in which all others are fixed
      EXPECT_EQ(model.constant(i, id<PrimitiveId>(n + 1)), index(i) == 0);  // only atom 0 is where the axes meet
    }
  }
}

/// The same with branches and intersecting axes; compared with distances at random configurations.
TEST(Crowds, OnManyAxesAreConstantExactlyWhenTheyNeverMoveApart) {
  std::size_t constant = 0, walked = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Random random(seed);
    const std::vector<Revolute> axes = {{Vec3::UnitZ(), Vec3::Zero(), {}, {}},
                                        {Vec3::UnitX(), Vec3::Zero(), {}, {}},
                                        {Vec3::UnitZ(), Vec3::UnitX(), {}, {}}};
    const std::vector<Vec3> places = {{0, 0, 0}, {0, 0, 2}, {1, 0, 0}, {1, 0, 3}, {0.3, 0.7, 0.2}};
    ModelBuilder<Point> builder;
    std::vector<LinkId> links{world};
    for (int k = 0; k < 200; ++k) {
      const LinkId parent = random.one_in(3) ? links[random.below(links.size())] : links.back();
      const Joint joint = random.one_in(40) ? axes[1 + random.below(2)] : axes[0];
      links.push_back(builder.add_link(parent, joint, {Point{places[random.below(places.size())]}}));
    }
    const Model<Point> built = builder.finish();
    const auto model = std::make_shared<const SelectedModel<Point>>(built, DofSelection::all(built.tree()));
    State<Point> state(model);
    const std::size_t n = built.size();
    std::vector<double> least(n * n, 1e9), most(n * n, 0.0);
    for (int trial = 0; trial < 4; ++trial) {
      std::vector<double> q;
      for (std::size_t k = 0; k < n; ++k) q.push_back(random.uniform(-3.0, 3.0));
      state.update(q);
      for (std::size_t g = 0; g < model->groups()->size(); ++g) state.place(id<GroupId>(g));
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
          const double d = norm(Vec3(state.placed()[i].position - state.placed()[j].position));
          least[i * n + j] = std::min(least[i * n + j], d);
          most[i * n + j] = std::max(most[i * n + j], d);
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const bool expected = most[i * n + j] - least[i * n + j] < 1e-9;
        ASSERT_EQ(model->constant(id<PrimitiveId>(i), id<PrimitiveId>(j)), expected) << i << " " << j << " " << seed;
        constant += expected ? 1U : 0U;
      }
      // Counts atoms on the axis of their own joint for which the model lists no further group.
      const Joint& own = built.tree().joint(built.links()[i]);
      const bool on_own = built.primitives()[i].fixed_on_axis(own.point, own.axis);
      walked += on_own && model->also_fixed_in(id<PrimitiveId>(i)).empty() ? 1U : 0U;
    }
  }
  EXPECT_GT(walked, 100U);
  EXPECT_GT(constant, 1000U);
}

}  // namespace crowds_test
}  // namespace hinge
