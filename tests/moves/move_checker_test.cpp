// SPDX-License-Identifier: BSD-3-Clause
// Monte Carlo moves give the answers of queries over the whole model, and leave the state as fresh updates would.
#include "hinge/moves/move_checker.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "engine/count_allocations.hpp"
#include "engine/own_filters.hpp"
#include "engine/random_mechanism.hpp"
#include "engine/side_by_side.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/hierarchy.hpp"

namespace hinge {
namespace move_checker_test {

using test::allocations;
using test::ExcludedPairs;
using test::Random;

constexpr std::uint64_t seed = 2004;

bool test_all() { return std::getenv("HINGE_TEST_ALL") != nullptr; }

/// New values for a few different DOF: mostly small steps from q, sometimes any angle, a huge value or no change.
std::vector<DofChange> random_changes(Random& random, std::span<const double> q, double size) {
  std::vector<DofChange> changes;
  if (q.empty()) return changes;
  for (std::size_t k = 1 + random.below(random.one_in(6) ? q.size() : std::min<std::size_t>(3, q.size())); k-- > 0;) {
    const std::size_t dof = random.below(q.size());
    if (std::ranges::any_of(changes, [&](const DofChange& c) { return c.dof == dof; })) continue;
    double value = q[dof] + random.uniform(-size, size);
    if (random.one_in(20)) value = random.uniform(-3.0, 3.0);
    if (random.one_in(60)) value = random.uniform(-1e7, 1e7);
    if (random.one_in(20)) value = q[dof];
    changes.push_back({dof, value});
  }
  return changes;
}

template <class P>
void expect_bits(const P& a, const P& b) {
  const Aabb x = a.bounds(), y = b.bounds();
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(x.lower[k]), std::bit_cast<std::uint64_t>(y.lower[k]));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(x.upper[k]), std::bit_cast<std::uint64_t>(y.upper[k]));
  }
}

/// Every frame and primitive of the state has the bits of a freshly updated model.
template <class Moves, class H>
void expect_fresh(Moves& moves, H& reference) {
  reference.update(moves.configuration());
  const auto frames = reference.frames();
  for (std::size_t g = 0; g < frames.size(); ++g)
    ASSERT_EQ(moves.frame(id<GroupId>(g)).column, frames[g].column) << "group " << g;
  const auto placed = reference.placed();
  for (std::size_t i = 0; i < placed.size(); ++i) expect_bits(moves.placed(id<PrimitiveId>(i)), placed[i]);
}

struct Tally {
  std::size_t moves = 0, free = 0, accepted_colliding = 0;
  MoveCounts counts;
};

/// A random walk over a model; every move is compared with brute force.
template <class P, template <class, class, class> class EngineOf = Simd, class F>
void walk(const Model<P>& model, const DofSelection& selection, const F& filter, const TypedThresholds& matrix,
          Random& random, int steps, double size, Tally& tally) {
  Hierarchy<P, F, TypedThresholds, Brute> reference(model, selection, filter, matrix);
  MoveChecker moves(Hierarchy<P, F, TypedThresholds, EngineOf>(model, selection, filter, matrix));
  if (random.one_in(2)) {
    std::vector<double> q;
    for (std::size_t k = 0; k < moves.dof_count(); ++k) q.push_back(random.uniform(-3.0, 3.0));
    moves.set(q);
  }
  for (int step = 0; step < steps; ++step) {
    const std::vector<DofChange> changes = random_changes(random, moves.configuration(), size);
    std::vector<double> q(moves.configuration().begin(), moves.configuration().end());
    for (const DofChange& change : changes) q[change.dof] = change.value;
    reference.update(q);
    const std::vector<Hit> expected = reference.self_collisions();
    if (random.one_in(2)) {
      test::expect_same(moves.try_move_listed(changes), expected);
    } else {
      ASSERT_EQ(moves.try_move(changes), expected.empty()) << "step " << step;
    }
    if (testing::Test::HasFailure()) return;
    ++tally.moves;
    tally.free += expected.empty() ? 1 : 0;
    if (random.one_in(20)) expect_fresh(moves, reference);  // the state is unchanged while a move is pending
    if (random.one_in(20)) continue;                        // the next move discards the pending one
    if (random.one_in(30)) {
      moves.set(q);
    } else if (expected.empty() ? !random.one_in(4) : random.one_in(6)) {
      moves.accept();
      tally.accepted_colliding += expected.empty() ? 0 : 1;
      ASSERT_EQ(moves.collides(), !expected.empty());
      test::expect_same(moves.collisions(), expected);
    } else {
      moves.reject();
      EXPECT_THROW(moves.accept(), ConfigurationError);
    }
    if (step % 16 == 0) expect_fresh(moves, reference);
    if (testing::Test::HasFailure()) return;
  }
  expect_fresh(moves, reference);
  tally.counts.tried += moves.counts().tried;
  tally.counts.full_queries += moves.counts().full_queries;
}

/// Random models; every second one is sparse enough to be free in some states.
template <class P, template <class, class, class> class EngineOf>
void walk_random_models() {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Random random(seed);
  Tally tally;
  const int rounds = test_all() ? 400 : 12;
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE(round);
    const auto model =
        test::random_model(random, round % 3 == 0 ? 12 : 60, round % 4 == 0 ? 40 : 6, false, test::make_primitive<P>);
    const ExcludedPairs filter(model.size(), random, 4);
    TypedThresholds matrix = test::random_thresholds(model.size(), random);
    if (round % 2 == 0) matrix = {std::vector<std::uint16_t>(model.size(), 0), 1, {round % 4 == 0 ? 0.0 : 0.02}};
    walk<P, EngineOf>(model, test::random_selection(model.tree(), random), filter, matrix, random, 40, 0.1, tally);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(tally.free, tally.moves / 20);
  EXPECT_LT(tally.free, tally.moves);
  EXPECT_GT(tally.accepted_colliding, 0U);
  if (std::is_same_v<P, Point>) {
    EXPECT_LT(tally.counts.full_queries, tally.counts.tried);
    EXPECT_GT(tally.counts.full_queries, 0U);
  }
}

TEST(MoveChecker, AnswersForPointsAsFullQueries) { walk_random_models<Point, Simd>(); }
TEST(MoveChecker, AnswersForSpheresAsFullQueries) { walk_random_models<Sphere, Simd>(); }
TEST(MoveChecker, AnswersForCapsulesAsFullQueries) { walk_random_models<Capsule, Simd>(); }
TEST(MoveChecker, AnswersForTrianglesAsFullQueries) { walk_random_models<Triangle, Simd>(); }
TEST(MoveChecker, AnswersForCapsulesOfAnotherEngineAsFullQueries) { walk_random_models<Capsule, Lazy>(); }

TEST(MoveChecker, AsksAFilterDerivedFromAStockOne) {
  Random random(seed);
  Tally tally;
  for (int round = 0; round < 8; ++round) {
    const auto model = test::random_model(random, 60, 6, false, test::make_primitive<Point>);
    const TypedThresholds matrix{std::vector<std::uint16_t>(model.size(), 0), 1, {std::ldexp(0.25, round / 2)}};
    walk<Point>(model, DofSelection::all(model.tree()), test::own_filter<test::OwnOfList>(model, random), matrix,
                random, 40, 0.1, tally);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_LT(tally.counts.full_queries, tally.counts.tried);
  EXPECT_GT(tally.free, 0U);
  EXPECT_LT(tally.free, tally.moves);
}

/// A chain of `links` links with side branches, joints one length unit apart, three points per link. It resembles a
/// protein and has free states.
Model<Point> comb(Random& random, std::size_t links, const Vec3& at) {
  ModelBuilder<Point> builder;
  Pose origin;
  origin.translation = at;
  LinkId parent = builder.add_link(world, Fixed{origin}, {});
  for (std::size_t l = 0; l < links; ++l) {
    Pose next;
    next.translation = Vec3(1.0, 0.0, 0.0);
    Joint joint = Revolute{random.vector(1.0).normalized(), Vec3::Zero(), next, {}};
    if (l % 16 == 15) joint = Prismatic{Vec3::UnitX(), next, {}};
    parent = builder.add_link(parent, joint, {Point{{0.2, 0, 0}}, Point{{0.4, 0.1, 0}}, Point{{0.6, 0, 0.1}}});
    if (l % 3 == 0)
      builder.add_link(parent, Revolute{Vec3::UnitY(), Vec3(0.4, 0.1, 0), {}, {}},
                       {Point{{0.4, 0.5, 0}}, Point{{0.4, 0.7, 0.2}}});
  }
  return builder.finish();
}

using Chain = Hierarchy<Point, ExcludedPairs, TypedThresholds>;
using BruteChain = Hierarchy<Point, ExcludedPairs, TypedThresholds, Brute>;

/// Admits every pair of points of different links, with one threshold for all pairs.
template <class H>
H one_threshold(const Model<Point>& model, double threshold) {
  return {model, ExcludedPairs(std::vector<std::vector<PrimitiveId>>(model.size())),
          TypedThresholds(std::vector<std::uint16_t>(model.size(), 0), 1, {threshold})};
}

TEST(MoveChecker, LeavesNoTraceAfterManyMoves) {
  Random random(seed);
  const Model<Point> model = comb(random, 90, Vec3::Zero());
  MoveChecker moves(one_threshold<Chain>(model, 0.08));
  auto reference = one_threshold<Chain>(model, 0.08);
  const std::size_t wanted = test_all() ? 1'000'000 : 10'000;
  std::size_t accepted = 0, rejected = 0, wrong = 0;
  for (std::size_t step = 0; accepted < wanted && step < 20 * wanted; ++step) {
    std::vector<DofChange> changes;
    for (std::size_t k = 1 + random.below(2); k-- > 0;) {
      const std::size_t dof = random.below(moves.dof_count());
      const double value = moves.configuration()[dof] + random.uniform(-0.8, 0.8);
      if (changes.empty() || changes.front().dof != dof) changes.push_back({dof, value});
    }
    const bool is_free = moves.try_move(changes);
    if (step % 8 == 0) {
      std::vector<double> q(moves.configuration().begin(), moves.configuration().end());
      for (const DofChange& change : changes) q[change.dof] = change.value;
      reference.update(q);
      wrong += is_free == reference.self_collides() ? 1 : 0;
    }
    if (is_free) {
      moves.accept();
      ++accepted;
    } else {
      moves.reject();
      ++rejected;
    }
  }
  std::printf("%zu accepted, %zu rejected, %llu full queries\n", accepted, rejected,
              static_cast<unsigned long long>(moves.counts().full_queries));
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(accepted, wanted);
  EXPECT_GT(rejected, wanted / 1000);
  EXPECT_GT(moves.counts().recalled, rejected / 10);
  auto fresh = one_threshold<Chain>(model, 0.08);
  expect_fresh(moves, fresh);
  EXPECT_FALSE(fresh.self_collides());
}

TEST(MoveChecker, AnswersForThousandsOfPointsAsFullQueries) {
  // More than 256 blocks, so there are several levels of boxes, and rows of boxes that move as a whole.
  Random random(seed + 6);
  const Model<Point> model = comb(random, 1400, Vec3::Zero());
  ASSERT_GT(model.size(), 256 * detail::simd::width);
  MoveChecker moves(one_threshold<Chain>(model, 0.3));
  auto reference = one_threshold<Chain>(model, 0.3);
  std::size_t verdicts[2] = {0, 0};
  for (int step = 0; step < (test_all() ? 20'000 : 1000); ++step) {
    std::vector<DofChange> changes;
    for (std::size_t k = 1 + random.below(4); k-- > 0;) {
      const std::size_t dof = random.below(moves.dof_count());
      if (std::ranges::any_of(changes, [&](const DofChange& c) { return c.dof == dof; })) continue;
      changes.push_back({dof, moves.configuration()[dof] + random.uniform(-1.5, 1.5)});
    }
    std::vector<double> q(moves.configuration().begin(), moves.configuration().end());
    for (const DofChange& change : changes) q[change.dof] = change.value;
    reference.update(q);
    const bool is_free = moves.try_move(changes);
    ASSERT_EQ(is_free, !reference.self_collides()) << "step " << step;
    ++verdicts[is_free ? 1 : 0];
    if (is_free && !random.one_in(4)) moves.accept();
  }
  std::printf("%zu colliding, %zu free\n", verdicts[0], verdicts[1]);
  EXPECT_GT(verdicts[0], 20U);
  EXPECT_GT(verdicts[1], 20U);
  EXPECT_EQ(moves.counts().full_queries, 0U);
}

/// The engine sorts primitives into at most sixteen classes, whose thresholds may be larger than those of their pairs.
/// A pair that stopped a move must be compared with its own threshold in the next moves.
TEST(MoveChecker, ComparesRecentPairsWithTheirOwnThreshold) {
  // Each link slides along x. Its points are far from those of other links along y; only the first points of links 0
  // and 1 can meet.
  constexpr std::size_t links = 6, per_link = 16, types = 40;
  ModelBuilder<Point> builder;
  for (std::size_t l = 0; l < links; ++l) {
    std::vector<Point> points;
    for (std::size_t k = 0; k < per_link; ++k)
      points.push_back({Vec3(l == 1 ? 3.0 : 0.0, l < 2 && k == 0 ? 0.0 : 10.0 + double(l), double(k))});
    builder.add_link(world, Prismatic{Vec3::UnitX(), {}, {}}, points);
  }
  const Model<Point> model = builder.finish();
  // All types have one reach, so they share a class, and its threshold is 0.5.
  std::vector<double> between(types * types, 0.1);
  for (std::size_t t = 0; t < types; ++t) between[t * types + t] = 0.5;
  std::vector<std::uint16_t> type(model.size());
  for (std::size_t i = 0; i < type.size(); ++i) type[i] = static_cast<std::uint16_t>(i % types);
  MoveChecker moves(Chain(model, ExcludedPairs(std::vector<std::vector<PrimitiveId>>(model.size())),
                          TypedThresholds(type, types, between)));
  const auto is_free = [&](double gap) {
    const DofChange change{0, 3.0 - gap};
    return moves.try_move(std::span(&change, 1));
  };
  EXPECT_FALSE(is_free(0.05));
  EXPECT_TRUE(is_free(0.3));
  EXPECT_FALSE(is_free(0.06));
  EXPECT_GT(moves.counts().recalled, 0U);
  EXPECT_EQ(moves.counts().full_queries, 0U);
}

TEST(MoveChecker, AllocatesNothingOnceItIsWarm) {
  Random random(seed + 5);
  const Model<Point> model = comb(random, 90, Vec3::Zero());
  MoveChecker moves(one_threshold<Chain>(model, 0.08));
  std::vector<DofChange> changes(3);
  const auto step = [&] {
    for (std::size_t k = 0; k < changes.size(); ++k) {
      const std::size_t dof = k + changes.size() * random.below(moves.dof_count() / changes.size());
      changes[k] = {dof, moves.configuration()[dof] + random.uniform(-0.3, 0.3)};
    }
    if (moves.try_move(changes))
      moves.accept();
    else
      moves.reject();
  };
  for (int k = 0; k < 6000; ++k) step();
  const std::size_t before = allocations;
  for (int k = 0; k < 2000; ++k) step();
  EXPECT_EQ(allocations, before);
}

TEST(MoveChecker, StaysExactFarOut) {
  Random random(seed + 1);
  for (const double away : {1e4, 1e7, 1e9, 1e12, 1e15}) {
    SCOPED_TRACE(away);
    const Model<Point> model = comb(random, 40, Vec3(away, -away, away / 3));
    Tally tally;
    walk(model, DofSelection::all(model.tree()), ExcludedPairs(std::vector<std::vector<PrimitiveId>>(model.size())),
         TypedThresholds(std::vector<std::uint16_t>(model.size(), 0), 1, {0.09}), random, 60, 0.05, tally);
    if (HasFailure()) return;
  }
}

TEST(MoveChecker, StaysExactWithLongSlides) {
  Random random(seed + 2);
  const Model<Point> model = comb(random, 48, Vec3::Zero());
  MoveChecker moves(one_threshold<Chain>(model, 0.09));
  auto reference = one_threshold<BruteChain>(model, 0.09);
  for (const double slide : {0.0, 3.0, 1e3, 0.0, 1e10, 0.5, 1e40, 1.0, 1e300, 0.0, 0x1p1000, 0.0}) {
    SCOPED_TRACE(slide);
    for (std::size_t dof = 0; dof < moves.dof_count(); ++dof) {
      const auto& group = (*moves.model().groups())[id<GroupId>(dof + 1)];
      const bool slides = group.joint.kind == JointKind::prismatic;
      if (!slides && !random.one_in(6)) continue;
      const std::vector<DofChange> change{{group.dof, slides ? slide : random.uniform(-0.1, 0.1)}};
      std::vector<double> q(moves.configuration().begin(), moves.configuration().end());
      q[change[0].dof] = change[0].value;
      reference.update(q);
      ASSERT_EQ(moves.try_move(change), !reference.self_collides()) << dof;
      moves.accept();
    }
  }
  expect_fresh(moves, reference);
}

TEST(MoveChecker, AsksTiesThatMoveTogetherAgain) {
  // Whether a pair at its threshold collides depends on rounding, so it can change when both points move together.
  Random random(seed + 3);
  ModelBuilder<Point> builder;
  LinkId parent = builder.add_link(world, Revolute{Vec3(1, 2, 3), Vec3(0.3, 0, 0), {}, {}}, {});
  for (int l = 0; l < 6; ++l) {
    std::vector<Point> lattice;
    for (int k = 0; k < 20; ++k) lattice.push_back({{static_cast<double>(k), 3.0 * l, 0.0}});
    parent = builder.add_link(parent, Revolute{Vec3::UnitY(), Vec3::Zero(), {}, {}}, lattice);
  }
  const Model<Point> model = builder.finish();
  MoveChecker moves(one_threshold<Chain>(model, 3.0));
  auto reference = one_threshold<BruteChain>(model, 3.0);
  std::size_t sizes[2] = {0, 0};
  for (int step = 0; step < 300; ++step) {
    const std::vector<DofChange> change{{0, random.uniform(-3.0, 3.0)}};
    std::vector<double> q(moves.configuration().begin(), moves.configuration().end());
    q[0] = change[0].value;
    reference.update(q);
    const auto expected = reference.self_collisions();
    test::expect_same(moves.try_move_listed(change), expected);
    ASSERT_EQ(moves.try_move(change), expected.empty());
    if (HasFailure()) return;
    ++sizes[expected.empty() ? 0 : 1];
    if (random.one_in(2)) moves.accept();
  }
  EXPECT_GT(sizes[1], 0U);
}

TEST(MoveChecker, RefusesBadMovesAndKeepsTheState) {
  Random random(seed + 4);
  const Model<Point> model = comb(random, 20, Vec3::Zero());
  MoveChecker moves(one_threshold<Chain>(model, 0.01));
  const std::size_t dof = moves.dof_count();
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  std::size_t slide = 0;
  for (std::size_t g = 1; g < moves.model().groups()->size(); ++g)
    if ((*moves.model().groups())[id<GroupId>(g)].joint.kind == JointKind::prismatic)
      slide = (*moves.model().groups())[id<GroupId>(g)].dof;
  EXPECT_THROW(moves.accept(), ConfigurationError);
  ASSERT_TRUE(moves.try_move(std::vector<DofChange>{{1, 0.01}}));
  for (const std::vector<DofChange>& bad : std::vector<std::vector<DofChange>>{
           {{dof, 0.0}}, {{0, nan}}, {{0, inf}}, {{0, 0.1}, {1, -inf}}, {{2, 0.1}, {2, 0.1}}, {{slide, 0x1p1001}}}) {
    EXPECT_THROW(moves.try_move(bad), ConfigurationError);
    EXPECT_EQ(moves.configuration()[1], 0.0);
  }
  try {
    moves.try_move(std::vector<DofChange>{{3, nan}});
  } catch (const ConfigurationError& error) {
    EXPECT_NE(std::string(error.what()).find("configuration value 3"), std::string::npos) << error.what();
  }
  moves.accept();  // accepts the last valid move
  EXPECT_EQ(moves.configuration()[1], 0.01);
  EXPECT_THROW(moves.set(std::vector<double>(dof, nan)), ConfigurationError);
  EXPECT_THROW(moves.set(std::vector<double>(dof + 1, 0.0)), ConfigurationError);
  EXPECT_EQ(moves.configuration()[1], 0.01);
}

TEST(MoveChecker, TakesModelsWithoutPrimitivesOrDof) {
  ModelBuilder<Point> builder;
  builder.add_link(world, Revolute{}, {});
  MoveChecker bare(one_threshold<Chain>(builder.finish(), 1.0));
  EXPECT_TRUE(bare.try_move(std::vector<DofChange>{{0, 1.0}}));
  bare.accept();
  EXPECT_EQ(bare.configuration()[0], 1.0);
  MoveChecker empty(one_threshold<Chain>(ModelBuilder<Point>().finish(), 1.0));
  EXPECT_TRUE(empty.try_move({}));
  empty.accept();
}

}  // namespace move_checker_test
}  // namespace hinge
