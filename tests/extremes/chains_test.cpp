// SPDX-License-Identifier: BSD-3-Clause
// Tests extremes of chains: extreme angles, 100 000 joints, 100 000 updates (a million with HINGE_TEST_ALL).
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <numbers>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "extremes/stack_used.hpp"
#include "extremes/three_engines.hpp"

namespace hinge {
namespace chains_test {

using test::AnyEngine;
using test::one_type;
using test::Random;

static_assert(std::numeric_limits<long double>::digits >= 64,
              "the reference of these tests has to be finer than double");

/// A pose in extended precision: textbook forward kinematics that shares no code with the library.
struct Reference {
  using Real = long double;
  std::array<std::array<Real, 3>, 3> r{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<Real, 3> t{};

  void translate(const Vec3& by) {
    for (std::size_t i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) t[i] += r[i][static_cast<std::size_t>(k)] * static_cast<Real>(by[k]);
  }
  /// Rotates about a coordinate axis.
  void turn(std::size_t axis, double angle) {
    const Real s = std::sin(static_cast<Real>(angle)), c = std::cos(static_cast<Real>(angle));
    const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (auto& row : r) {
      const Real x = row[a], y = row[b];
      row[a] = x * c + y * s;
      row[b] = y * c - x * s;
    }
  }
};

constexpr double bond = 1.45;  // angstrom, as in a protein backbone

struct Chain {
  Model<Point> model;
  std::vector<std::size_t> axes;
};

/// A chain with one point at the end of each link.
Chain chain(std::size_t joints, Random& random) {
  ModelBuilder<Point> builder;
  std::vector<std::size_t> axes;
  LinkId parent = world;
  Pose step;
  step.translation = Vec3(bond, 0, 0);
  for (std::size_t k = 0; k < joints; ++k) {
    axes.push_back(random.below(3));
    Vec3 axis = Vec3::Zero();
    axis[static_cast<Eigen::Index>(axes.back())] = 1.0;
    parent = builder.add_link(parent, Revolute{axis, Vec3::Zero(), step, {}}, {Point{Vec3(bond, 0, 0)}});
  }
  return {builder.finish(), axes};
}

/// Returns the largest distance of a placed point from its position in extended precision.
double largest_error(const Chain& chain, const std::vector<double>& q, std::span<const Point> placed) {
  Reference reference;
  long double largest = 0.0L;
  for (std::size_t k = 0; k < q.size(); ++k) {
    reference.translate(Vec3(bond, 0, 0));
    reference.turn(chain.axes[k], q[k]);
    Reference end = reference;
    end.translate(Vec3(bond, 0, 0));
    long double square = 0.0L;
    for (int i = 0; i < 3; ++i) {
      const long double off = end.t[static_cast<std::size_t>(i)] - static_cast<long double>(placed[k].position[i]);
      square += off * off;
    }
    largest = std::max(largest, std::sqrt(square));
  }
  return static_cast<double>(largest);
}

TEST(Chains, AtHugeTinyAndStraightAnglesEqualExactKinematics) {
  constexpr double pi = std::numbers::pi;
  const std::vector<double> angles = {1e6, -1e6, pi, -pi, 1e-12, -1e-12, 2 * pi, 5e-324, 1e15, 0.0, 1.0};
  Random random(1);
  const std::size_t n = 60;
  const Chain made = chain(n, random);
  for (AnyEngine<Point>& engine : test::atoms_on_three_engines(made.model, one_type(n, 1.0)))
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<double> q(n);
      for (double& value : q) value = angles[random.below(angles.size())];
      engine.update(q);
      const double reach = bond * static_cast<double>(n + 1);
      EXPECT_LT(largest_error(made, q, engine.placed()), 1e-9 * reach) << engine.name;
    }
}

TEST(Chains, OfAHundredThousandJointsAreExactToABillionthWithoutRecursion) {
  Random random(2);
  const std::size_t n = 100000;
  const Chain made = chain(n, random);
  for (const bool coiled : {true, false}) {
    std::vector<double> q(n);
    for (double& value : q) value = coiled ? random.uniform(-3.0, 3.0) : random.uniform(-1e-3, 1e-3);
    std::vector<std::vector<Hit>> hits;
    std::size_t used = 0;
    for (std::size_t e = 1; e < 3; ++e) {
      std::vector<Point> placed;
      used = std::max(used, test::stack_used([&] {
                        AnyEngine<Point> engine = test::atoms_on_three_engines(made.model, one_type(n, 1.0))[e];
                        engine.update(q);
                        hits.push_back(engine.within(0.0, {}));
                        placed.assign(engine.placed().begin(), engine.placed().end());
                      }));
      const double length = bond * static_cast<double>(n + 1), error = largest_error(made, q, placed);
      std::cout << (coiled ? "coil" : "stretched") << ": error " << error / length << " of the length, " << used
                << " bytes of stack\n";
      EXPECT_LT(error, 1e-8 * length);
    }
    EXPECT_TRUE(hits[0] == hits[1]);
    EXPECT_EQ(hits[0].empty(), !coiled);
    if (!test::stack_is_padded) {
      EXPECT_LT(used, test::stack_limit);
    }
  }
}

/// Groups of twenty points, for which the SIMD engine keeps local frames, and groups of two, which share blocks.
Model<Point> mixed_chain(Random& random) {
  ModelBuilder<Point> builder;
  LinkId parent = world;
  for (int k = 0; k < 8; ++k) {
    std::vector<Point> points;
    for (std::size_t p = k % 3 == 0 ? 20 : 2; p-- > 0;) points.push_back({random.vector(1.5)});
    const Vec3 axis = random.vector(1.0);
    Joint joint = Revolute{axis, random.vector(1.0), random.pose(1.0), {}};
    if (k == 5) joint = Prismatic{axis, random.pose(1.0), {}};
    parent = builder.add_link(k == 4 ? world : parent, joint, points);
  }
  return builder.finish();
}

/// The latest state, so that a fresh engine can be set to it directly.
struct State {
  std::vector<double> q;
  std::vector<Pose> poses;
  std::vector<Point> placed;
  enum class Kind { configuration, poses, placed } kind = Kind::configuration;

  void give_to(AnyEngine<Point>& engine) const {
    if (kind == Kind::configuration) engine.update(q);
    if (kind == Kind::poses) engine.update_poses(poses);
    if (kind == Kind::placed) engine.update_placed(placed);
  }
};

void expect_same_bits(AnyEngine<Point>& engine, AnyEngine<Point>& fresh) {
  ASSERT_EQ(engine.collides({}), fresh.collides({}));
  ASSERT_EQ(engine.within(0.4, {}), fresh.within(0.4, {}));
  const auto closest = engine.closest({}), expected = fresh.closest({});
  ASSERT_EQ(std::bit_cast<std::uint64_t>(closest->gap()), std::bit_cast<std::uint64_t>(expected->gap()));
  const std::span<const Point> a = engine.placed(), b = fresh.placed();
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int k = 0; k < 3; ++k)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(a[i].position[k]), std::bit_cast<std::uint64_t>(b[i].position[k]));
}

TEST(Chains, AfterAHundredThousandUpdatesEqualAFreshModelBitForBit) {
  const std::size_t updates = test::exhaustive() ? 1000000 : 100000, rest = 1009;  // updates between two comparisons
  for (std::size_t e = 0; e < 3; ++e) {
    Random random(3);
    std::cout << "seed 3\n";
    const Model<Point> model = mixed_chain(random);
    const TypedThresholds matrix = one_type(model.size(), 0.25);
    AnyEngine<Point> engine = test::atoms_on_three_engines(model, matrix)[e];
    SCOPED_TRACE(engine.name);
    State state;
    state.q.assign(model.tree().dof_count(), 0.0);
    std::size_t looks = 0;
    for (std::size_t step = 1; step <= updates; ++step) {
      state.kind = State::Kind::configuration;
      if (random.one_in(50)) {
        state.kind = random.one_in(2) ? State::Kind::poses : State::Kind::placed;
        state.poses.assign(model.tree().dof_count() + 1, Pose{});
        for (std::size_t g = 1; g < state.poses.size(); ++g) state.poses[g] = random.pose(3.0);
        const std::span<const Point> now = engine.placed();
        state.placed.assign(now.begin(), now.end());
        state.placed[random.below(state.placed.size())].position += random.vector(1.0);
      } else {
        // Usually at most one value changes, so that most groups do not move; sometimes many do.
        const std::size_t changed = random.one_in(4) ? state.q.size() : random.below(2);
        for (std::size_t k = 0; k < changed; ++k) state.q[random.below(state.q.size())] = random.uniform(-4.0, 4.0);
      }
      state.give_to(engine);
      QueryOptions options;
      options.moved_only = random.one_in(2);
      switch (random.below(8)) {  // some steps have no query, so groups are not placed in every step
        case 0: engine.within(0.2, options); break;
        case 1: engine.closest(options); break;
        case 2:
        case 3:
        case 4: engine.collides(options); break;
        default: break;
      }
      if (step % rest != 0 && step != updates) continue;
      ++looks;
      AnyEngine<Point> fresh = test::atoms_on_three_engines(model, matrix)[e];
      state.give_to(fresh);
      expect_same_bits(engine, fresh);
      if (HasFatalFailure()) FAIL() << "after " << step << " updates";
    }
    EXPECT_EQ(looks, updates / rest + 1);
  }
}

}  // namespace chains_test
}  // namespace hinge
