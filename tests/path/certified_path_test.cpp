// SPDX-License-Identifier: BSD-3-Clause
// Certified paths against sampled states: free paths are free, colliding states collide, and motion bounds hold.
#include "hinge/path/certified_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/detail/path/displacements.hpp"
#include "hinge/detail/path/group_rates.hpp"
#include "hinge/detail/path/near_links.hpp"
#include "hinge/detail/path/relative_motion.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/path/check_sampled.hpp"
#include "hinge/policy/different_links.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge {
namespace certified_path_test {

using std::numbers::pi;
using test::Random;

bool all_variants() { return std::getenv("HINGE_TEST_ALL") != nullptr; }

template <class P, template <class, class, class> class EngineOf = Brute>
using Bodies = Hierarchy<P, DifferentLinks, UniformClearance, EngineOf>;

template <template <class, class, class> class EngineOf = Brute, class P>
Bodies<P, EngineOf> bodies(const Model<P>& model, double clearance,
                           std::vector<std::pair<LinkId, LinkId>> ignored = {}) {
  return {model, DifferentLinks({model.links().begin(), model.links().end()}, std::move(ignored)),
          UniformClearance(clearance)};
}

std::vector<double> state(const std::vector<double>& from, const std::vector<double>& to, double t) {
  std::vector<double> q(from.size());
  for (std::size_t k = 0; k < q.size(); ++k) q[k] = from[k] + t * (to[k] - from[k]);
  return q;
}

Point make(Random& random, const Point*) { return {random.vector(2.0)}; }
Capsule make(Random& random, const Capsule*) {
  const Vec3 a = random.vector(1.0);
  return {a, a + random.vector(0.7), random.uniform(0.0, 0.2)};
}
Triangle make(Random& random, const Triangle*) {
  const Vec3 a = random.vector(1.0);
  return {a, a + random.vector(0.7), a + random.vector(0.7)};
}

/// Revolute, prismatic and fixed joints in any order, with joint origins, branches and common ancestors.
template <class P>
Model<P> random_tree(Random& random, std::size_t links = 12, std::size_t most = 3) {
  return test::random_model(random, links, most, false, [](Random& r, const Vec3&, const Vec3&) {
    return make(r, static_cast<const P*>(nullptr));
  });
}

struct Verdicts {
  int free = 0, colliding = 0, undecided = 0;
};

/// Compares verdicts of certified paths with brute force at `states` states per path.
template <class P>
Verdicts hold_against_brute_force(std::uint64_t seed, int cases, int states) {
  Verdicts verdicts;
  for (int c = 0; c < cases; ++c) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(c));
    Random random(seed + 1000 * static_cast<std::uint64_t>(c));
    const Model<P> model = random_tree<P>(random);
    const double clearance = random.one_in(4) ? 0.0 : random.uniform(0.0, IsPointLike<P> ? 1.2 : 0.4);
    Bodies<P> plain = bodies(model, clearance);
    std::vector<double> from(plain.dof_count()), to(from);
    const double amplitude = std::pow(10.0, random.uniform(-2.5, 0.5));
    for (double& q : from) q = random.uniform(-pi, pi);
    for (std::size_t k = 0; k < to.size(); ++k)
      to[k] = from[k] + (random.one_in(4) ? 0.0 : random.uniform(-amplitude, amplitude));
    const PathAnswer answer = c % 2 == 0 ? CertifiedPath(plain).check(from, to)
                                         : CertifiedPath(bodies<Simd>(model, clearance)).check(from, to);
    EXPECT_LE(answer.counts.pairs_proved, answer.counts.pairs_listed);
    switch (answer.verdict) {
      case PathVerdict::free:
        ++verdicts.free;
        EXPECT_FALSE(answer.hit.has_value());
        for (int k = 0; k < states; ++k) {
          plain.update(state(from, to, static_cast<double>(k) / (states - 1)));
          if (plain.self_collides()) {
            ADD_FAILURE() << "called free, collides at " << k;
            break;
          }
        }
        break;
      case PathVerdict::colliding: {
        ++verdicts.colliding;
        EXPECT_GE(answer.parameter, 0.0);
        EXPECT_LE(answer.parameter, 1.0);
        for (std::size_t k = 0; k < from.size(); ++k)
          EXPECT_NEAR(answer.configuration[k], from[k] + answer.parameter * (to[k] - from[k]), 1e-14 * 10);
        plain.update(answer.configuration);
        const std::vector<Hit> hits = plain.self_collisions();
        EXPECT_NE(std::find(hits.begin(), hits.end(), answer.hit.value()), hits.end());
        break;
      }
      case PathVerdict::undecided: ++verdicts.undecided; break;
    }
  }
  return verdicts;
}

template <class P>
class CertifiedPaths : public testing::Test {};
using Primitives = testing::Types<Point, Capsule, Triangle>;
TYPED_TEST_SUITE(CertifiedPaths, Primitives);

TYPED_TEST(CertifiedPaths, AgreeWithBruteForceAtAThousandStates) {
  const int cases = all_variants() ? 3000 : 150;
  const Verdicts verdicts = hold_against_brute_force<TypeParam>(11, cases, 1000);
  EXPECT_GT(verdicts.free, cases / 12);
  EXPECT_GT(verdicts.colliding, cases / 12);
  EXPECT_EQ(verdicts.undecided, 0);
}

/// A capsule on an arm rotates above a floor. Length of the arm and height of its joint, in the model's length unit.
constexpr double arm = 2.0, height = 1.0;

Bodies<Capsule> arm_above_floor(double clearance, double scale = 1.0, const Vec3& away = Vec3::Zero()) {
  ModelBuilder<Capsule> build;
  const double simd = 20.0 * scale;
  // The floor is a capsule of radius 0 along x.
  build.add_primitive(world, {Vec3(-simd, 0, 0) + away, Vec3(simd, 0, 0) + away, 0.0});
  const Vec3 joint = Vec3(0, 0, height * scale) + away;
  build.add_link(world, Revolute{Vec3::UnitY(), joint, {}, {}},
                 {Capsule{joint + Vec3(0, 0, arm * scale), joint + Vec3(0, 0, arm * scale), 0.0}});
  return bodies(build.finish(), clearance * scale);
}

TEST(CertifiedPath, AnswersForASwingThatIsKnown) {
  // The tip is height + arm cos q above the floor. The clearance is just above or just below the smallest such
  // height.
  Random random(23);
  int free = 0, colliding = 0;
  for (int c = 0; c < 2000; ++c) {
    const double from = random.uniform(-1.0, 0.5), to = random.uniform(from, 1.5);
    const double lowest = height + arm * std::min(std::cos(from), std::cos(to));
    const double above = std::pow(10.0, random.uniform(-9.0, -1.0)) * (random.one_in(2) ? 1.0 : -1.0);
    CertifiedPath certified(arm_above_floor(lowest + above));
    const PathAnswer answer = certified.check(std::vector{from}, std::vector{to}, 0x1p-40);
    EXPECT_EQ(answer.verdict, above < 0.0 ? PathVerdict::free : PathVerdict::colliding)
        << from << ' ' << to << ' ' << above;
    free += answer.verdict == PathVerdict::free;
    colliding += answer.verdict == PathVerdict::colliding;
  }
  EXPECT_GT(free, 500);
  EXPECT_GT(colliding, 500);
}

/// A point slides straight towards another point and stops at distance `gap`. Or the point is the tip of an arm, and
/// the other point is `gap` outside the tip's circle, at the angle pi.
template <template <class, class, class> class EngineOf>
void come_near_a_point() {
  Random random(31);
  int free = 0, colliding = 0;
  for (int c = 0; c < 1000; ++c) {
    const bool slides = random.one_in(2);
    const double gap = random.uniform(0.1, 1.0), from = random.uniform(2.0, pi);
    const double to = slides ? pi : random.uniform(pi, 5.0);
    const double above = std::pow(10.0, random.uniform(-9.0, -1.5)) * (random.one_in(2) ? 1.0 : -1.0);
    ModelBuilder<Point> build;
    build.add_primitive(world, Point{Vec3(0, 0, -arm - gap)});
    const Vec3 origin(0, 0, 0);
    if (slides)
      build.add_link(world, Prismatic{Vec3(0, 0, -1), {}, {}}, {Point{Vec3(0, 0, pi - arm)}});
    else
      build.add_link(world, Revolute{Vec3::UnitY(), origin, {}, {}}, {Point{Vec3(0, 0, arm)}});
    CertifiedPath certified(bodies<EngineOf>(build.finish(), gap + above));
    const PathAnswer answer = certified.check(std::vector{from}, std::vector{to}, 0x1p-40);
    EXPECT_EQ(answer.verdict, above < 0.0 ? PathVerdict::free : PathVerdict::colliding)
        << gap << ' ' << from << ' ' << to << ' ' << above;
    free += answer.verdict == PathVerdict::free;
    colliding += answer.verdict == PathVerdict::colliding;
  }
  EXPECT_GT(free, 300);
  EXPECT_GT(colliding, 300);
}

TEST(CertifiedPath, AnswersForAPointThatComesNearAnother) {
  come_near_a_point<Brute>();
  come_near_a_point<Lazy>();
  come_near_a_point<Simd>();
}

/// Excludes all pairs, although its base admits all.
struct NoPair : AdmitAll {
  bool admits(PrimitiveId, PrimitiveId) const noexcept { return false; }
};

template <class P>
Model<P> arm_and_obstacle(const P& tip, const P& obstacle) {
  ModelBuilder<P> builder;
  builder.add_link(world, Revolute{}, {tip});
  builder.add_link(world, Fixed{}, {obstacle});
  return builder.finish();
}

template <class P>
void expect_filter_is_asked(const Model<P>& model) {
  const std::vector from{0.0}, to{pi};
  EXPECT_EQ(CertifiedPath(bodies<Simd>(model, 0.1)).check(from, to).verdict, PathVerdict::colliding);
  CertifiedPath none(Hierarchy(model, NoPair{}, UniformClearance(0.1)));
  EXPECT_EQ(none.check(from, to).verdict, PathVerdict::free);
}

TEST(CertifiedPath, AsksAFilterDerivedFromAStockOne) {
  expect_filter_is_asked(arm_and_obstacle(Point{{1, 0, 0}}, Point{{0, 1, 0}}));
  expect_filter_is_asked(
      arm_and_obstacle(Triangle{{1, 0, 0}, {2, 0, 0}, {1, 0, 1}}, Triangle{{0, 1, 0}, {0, 2, 0}, {0, 1, 1}}));
}

/// A copy and a moved-to object keep no data of the first object's path.
TEST(CertifiedPath, MayBeCopiedAndMovedAfterAPath) {
  CertifiedPath first(bodies<Simd>(arm_and_obstacle(Point{{1, 0, 0}}, Point{{0, 1, 0}}), 0.1));
  const auto check = [](auto& path, double to) { return path.check(std::vector{0.0}, std::vector{to}).verdict; };
  EXPECT_EQ(check(first, 1.0), PathVerdict::free);
  CertifiedPath copy(first);
  EXPECT_EQ(check(copy, pi), PathVerdict::colliding);
  CertifiedPath moved(std::move(first));
  copy = moved;
  EXPECT_EQ(check(moved, pi), PathVerdict::colliding);
  EXPECT_EQ(check(copy, 1.0), PathVerdict::free);
}

TEST(CertifiedPath, AnswersTheSameWhateverTheUnit) {
  for (const double clearance : {1.5, 1.9, 2.2}) {
    CertifiedPath one(arm_above_floor(clearance));
    const PathAnswer expected = one.check(std::vector{-0.7}, std::vector{1.1});
    for (const double scale : {0x1p-900, 0x1p-500, 0x1p-30, 0x1p40, 0x1p500, 0x1p900}) {
      SCOPED_TRACE(scale);
      CertifiedPath certified(arm_above_floor(clearance, scale));
      const PathAnswer answer = certified.check(std::vector{-0.7}, std::vector{1.1});
      EXPECT_EQ(answer.verdict, expected.verdict);
      EXPECT_NEAR(answer.parameter, expected.parameter, 1e-12);
      EXPECT_EQ(answer.counts.segments, expected.counts.segments);
      EXPECT_EQ(answer.counts.pairs_proved, expected.counts.pairs_proved);
    }
  }
}

TEST(CertifiedPath, AllowsForRoundingFarFromTheOrigin) {
  // At 1e9 coordinates have errors of about 1e-7. The proof allows for about a thousand times as much, and smaller
  // gaps may be left undecided.
  Random random(29);
  for (int c = 0; c < 100; ++c) {
    const double from = random.uniform(-1.0, 0.5), to = random.uniform(from + 1e-3, 1.5);
    const double lowest = height + arm * std::min(std::cos(from), std::cos(to));
    const double above = std::pow(10.0, random.uniform(-10.0, -2.0)) * (random.one_in(2) ? 1.0 : -1.0);
    Bodies<Capsule> plain = arm_above_floor(lowest + above, 1.0, Vec3(1e9, -2e9, 1e9));
    CertifiedPath certified(plain);
    const PathAnswer answer = certified.check(std::vector{from}, std::vector{to});
    EXPECT_TRUE(std::abs(above) < 1e-3 || answer.verdict != PathVerdict::undecided) << above;
    if (answer.verdict != PathVerdict::free) continue;
    for (int k = 0; k <= 1000; ++k) {
      plain.update(state({from}, {to}, k / 1000.0));
      ASSERT_FALSE(plain.self_collides()) << k << ' ' << above;
    }
  }
}

TEST(CertifiedPath, OfNoLengthIsTheQuery) {
  for (const double clearance : {1.0, 2.9999, 3.0, 3.0001}) {
    Bodies<Capsule> plain = arm_above_floor(clearance);
    CertifiedPath certified(plain);
    const PathAnswer answer = certified.check(std::vector{0.0}, std::vector{0.0});
    EXPECT_EQ(answer.verdict, plain.self_collides() ? PathVerdict::colliding : PathVerdict::free) << clearance;
  }
  // A model without a DOF.
  ModelBuilder<Point> build;
  build.add_primitive(world, Point{});
  build.add_link(world, Fixed{}, {Point{Vec3::UnitX()}});
  CertifiedPath still(bodies(build.finish(), 2.0));
  EXPECT_TRUE(still.check({}, {}).is_free());  // queries do not test pairs whose distance cannot change
  // A model without primitives.
  CertifiedPath empty(bodies(ModelBuilder<Triangle>().finish(), 1.0));
  EXPECT_TRUE(empty.check({}, {}).is_free());
}

TEST(CertifiedPath, TurnsManyTimes) {
  const double turns = 40 * pi;
  // The tip crosses the floor at every turn; it never reaches a floor below its circle.
  CertifiedPath through(arm_above_floor(0.01));
  EXPECT_EQ(through.check(std::vector{0.0}, std::vector{turns}).verdict, PathVerdict::colliding);
  ModelBuilder<Capsule> build;
  build.add_primitive(world, {Vec3(-20, 0, -1.01), Vec3(20, 0, -1.01), 0.0});
  const Vec3 joint(0, 0, height);
  build.add_link(world, Revolute{Vec3::UnitY(), joint, {}, {}}, {Capsule{joint, joint + Vec3(0, 0, arm), 0.0}});
  const Model<Capsule> model = build.finish();
  CertifiedPath free(bodies(model, 0.0));
  const PathAnswer answer = free.check(std::vector{-3.0}, std::vector{turns});
  EXPECT_EQ(answer.verdict, PathVerdict::free);
  EXPECT_GT(answer.counts.segments, 100U);
  CertifiedPath closer(bodies(model, 0.0101));
  EXPECT_EQ(closer.check(std::vector{-3.0}, std::vector{turns}).verdict, PathVerdict::colliding);
  // So many turns that no segment is short enough to be proved: not free, and found in bounded time.
  CertifiedPath hopeless(bodies(model, 0.0));
  for (const double far : {1e12, 1e160, 1e300})
    EXPECT_NE(hopeless.check(std::vector{0.0}, std::vector{far}).verdict, PathVerdict::free) << far;
}

/// A point that slides along x towards a point at the origin.
Bodies<Point> slider(double clearance) {
  ModelBuilder<Point> build;
  build.add_primitive(world, Point{});
  build.add_link(world, Prismatic{Vec3::UnitX(), {}, {}}, {Point{Vec3(0, 0, 0)}});
  return bodies(build.finish(), clearance);
}

TEST(CertifiedPath, LeavesExactTiesUndecidedAndSaysWhere) {
  CertifiedPath certified(slider(1.0));
  EXPECT_EQ(certified.check(std::vector{4.0}, std::vector{1.0 + 1e-9}).verdict, PathVerdict::free);
  const PathAnswer beyond = certified.check(std::vector{4.0}, std::vector{1.0 - 1e-9});
  EXPECT_EQ(beyond.verdict, PathVerdict::colliding);
  EXPECT_NEAR(beyond.parameter, 1.0, 1e-9);
  const PathAnswer tie = certified.check(std::vector{4.0}, std::vector{1.0});
  EXPECT_EQ(tie.verdict, PathVerdict::undecided);
  EXPECT_NEAR(tie.parameter, 1.0, 0x1p-18);
  EXPECT_LE(tie.half_width, smallest_path_step);
  ASSERT_TRUE(tie.hit.has_value());
  EXPECT_NEAR(tie.hit->distance, 1.0, 1e-5);
  // At a threshold of 0, points pass through each other.
  CertifiedPath bodiless(slider(0.0));
  EXPECT_EQ(bodiless.check(std::vector{4.0}, std::vector{-4.0}).verdict, PathVerdict::free);
}

TEST(CertifiedPath, MovesABaseThatFliesFreely) {
  // Six joints of one DOF each let a link move freely.
  for (const double height_over : {0.45, 0.2, 0.05}) {
    ModelBuilder<Triangle> build;
    build.add_primitive(world, {Vec3(-5, -5, 0), Vec3(5, -5, 0), Vec3(0, 8, 0)});
    LinkId link = world;
    std::vector<std::pair<LinkId, LinkId>> none;
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
      link = build.add_link(link, Prismatic{axis, {}, {}});
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
      link = build.add_link(link, Revolute{axis, Vec3::Zero(), {}, {}});
    build.add_primitive(link, {Vec3(0.3, 0, 0), Vec3(-0.3, 0.1, 0), Vec3(-0.3, -0.1, 0)});
    Bodies<Triangle> plain = bodies(build.finish(), 0.0);
    CertifiedPath certified(plain);
    const std::vector<double> from{-1, 0.2, height_over, 0, 0, 0}, to{1, -0.2, height_over, 1.0, 2.5, -1.0};
    const PathAnswer answer = certified.check(from, to);
    const PathAnswer sampled = check_sampled(plain, from, to, 1e-3);
    EXPECT_EQ(answer.verdict, sampled.verdict) << height_over;
  }
}

/// A sphere of triangles around `centre`.
std::vector<Triangle> ball(const Vec3& centre, double radius, int around, int along) {
  const auto corner = [&](int i, int j) {
    const double a = 2 * pi * (i % around) / around, b = pi * j / along;
    return Vec3(centre + radius * Vec3(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b)));
  };
  std::vector<Triangle> triangles;
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      triangles.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  return triangles;
}

TEST(CertifiedPath, ProvesLinksOfManyTrianglesAsWholes) {
  // One ball rotates and slides along another at a distance below the size of their triangles, so many pairs are
  // near.
  for (const double gap : {-0.2, -0.02, 1e-3, 0.05, 0.3}) {
    SCOPED_TRACE(gap);
    ModelBuilder<Triangle> build;
    for (const Triangle& t : ball(Vec3::Zero(), 1.0, 10, 5)) build.add_primitive(world, t);
    const LinkId slide = build.add_link(world, Prismatic{Vec3::UnitX(), {}, {}});
    build.add_link(slide, Revolute{Vec3(0.2, 1, 0.1), Vec3(0, 0, 2.0 + gap), {}, {}},
                   ball(Vec3(0, 0, 2.0 + gap), 1.0, 10, 5));
    Bodies<Triangle> plain = bodies(build.finish(), 0.0);
    CertifiedPath certified(plain);
    const std::vector from{-0.6, -0.4}, to{0.7, 0.5};
    const PathAnswer answer = certified.check(from, to);
    const PathAnswer sampled = check_sampled(plain, from, to, 0.01);
    EXPECT_EQ(answer.verdict, sampled.verdict);
    EXPECT_TRUE(std::abs(gap + 0.05) < 0.05 || answer.is_free() == (gap > 0.0));  // the balls have flat sides
  }
}

TEST(CertifiedPath, AnswersTheSameOnEveryEngine) {
  int free = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed + 500);
    const Model<Point> model = random_tree<Point>(random);
    const TypedThresholds thresholds = test::random_thresholds(model.size(), random);
    const test::ExcludedPairs pairs(model.size(), random, 3);
    const DofSelection selection = test::random_selection(model.tree(), random);
    Hierarchy<Point, test::ExcludedPairs, TypedThresholds, Brute> brute(model, selection, pairs, thresholds);
    Hierarchy<Point, test::ExcludedPairs, TypedThresholds, Simd> simd(model, selection, pairs, thresholds);
    std::vector<double> from(brute.dof_count()), to(from);
    for (double& q : from) q = random.uniform(-1, 1);
    for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[k] + random.uniform(-0.3, 0.3);
    CertifiedPath by_brute(brute);
    CertifiedPath by_simd(simd);
    const PathAnswer a = by_brute.check(from, to), b = by_simd.check(from, to);
    EXPECT_EQ(a.verdict, b.verdict);
    EXPECT_EQ(a.parameter, b.parameter);
    if (a.is_free()) {  // otherwise the first colliding pair ends the check, and engines order pairs differently
      EXPECT_EQ(a.counts.pairs_listed, b.counts.pairs_listed);
      ++free;
    }
    const PathAnswer again = by_simd.check(from, to);
    EXPECT_EQ(again.counts.pairs_proved, b.counts.pairs_proved);
  }
  EXPECT_GT(free, 5);
}

/// Point `local` of `group` in the frame of the group `held`, at configuration q.
Vec3 seen_from(Bodies<Point>& hierarchy, const std::vector<double>& q, std::uint32_t held, std::uint32_t group,
               const Vec3& local) {
  hierarchy.update(q);
  return hierarchy.frames()[held].pose().inverse() * (hierarchy.frames()[group].pose() * local);
}

TEST(RelativeMotion, BoundsFiniteDifferences) {
  constexpr double half = 0.02, step = 1e-3;
  double tightest = 0.0;
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed + 7000);
    Bodies<Point> plain = bodies(random_tree<Point>(random), 0.1);
    const std::size_t groups = plain.frames().size();
    if (groups < 2) continue;
    std::vector<double> from(plain.dof_count()), to(from);
    for (double& q : from) q = random.uniform(-pi, pi);
    for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[k] + random.uniform(-3.0, 3.0);
    detail::GroupRates rates(plain.model());
    rates.begin(StraightPath(from, to, from.size()));
    plain.update(state(from, to, 0.5));
    rates.set_middle(plain.frames());
    for (int k = 0; k < 10; ++k) {
      const auto a = static_cast<std::uint32_t>(random.below(groups)),
                 b = static_cast<std::uint32_t>(random.below(groups));
      if (a == b) continue;
      detail::RelativeMotion motion;
      detail::FindRelativeMotion()(rates.groups(), a, b, half, motion);
      // The test compares lengths in the model's unit.
      const double scale = rates.scale();
      double change = 0.0, bound = motion.points / scale;
      for (const bool second : {false, true}) {
        const std::uint32_t g = second ? b : a;
        const Vec3 local = random.vector(2.0);
        const detail::Twist twist = second ? motion.second : motion.first;
        plain.update(state(from, to, 0.5));
        const Vec3 at = plain.frames()[g].pose() * local;
        const Mat3 turned = plain.frames()[motion.held].pose().rotation;
        bound += (second ? motion.second_unit : motion.first_unit) *
                 norm(Vec3(at - (second ? motion.second_point : motion.first_point) / scale));
        const auto seen = [&](double t) { return seen_from(plain, state(from, to, t), motion.held, g, local); };
        const Vec3 velocity = product(turned, Vec3((seen(0.5 + 1e-5) - seen(0.5 - 1e-5)) / 2e-5));
        EXPECT_NEAR(norm(Vec3(velocity - twist.at(at * scale) / scale)), 0.0, 1e-6 * (1.0 + norm(velocity)));
        double largest = 0.0;
        for (double t = 0.5 - half; t <= 0.5 + half; t += half / 4)
          largest = std::max(largest, norm(Vec3(seen(t + step) - 2.0 * seen(t) + seen(t - step))) / (step * step));
        change += largest;
      }
      // Second differences have an error of step^2 / 12 times the fourth derivative.
      EXPECT_LE(change, bound * 1.001 + 1e-4) << a << ' ' << b;
      if (bound > 1e-3) tightest = std::max(tightest, change / bound);
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(tightest, 0.95);  // the bound is nearly reached
}

TEST(RelativeMotion, BoundsHowTurningChanges) {
  // Two revolute joints with perpendicular axes. The first one rotates the second axis, so w' = r1 r2 (a1 x a2).
  struct Joint {
    bool slides = false;
    double speed = 0.0;
  };
  detail::Change change;
  pass_joint(Joint{false, 2.0}, 0.1, 2.0, change);
  EXPECT_EQ(change.turning_change, 0.0);
  EXPECT_EQ(change.turning, 2.0);
  pass_joint(Joint{false, 3.0}, 0.1, std::sqrt(13.0), change);
  EXPECT_EQ(change.turning_change, 6.0);
  EXPECT_EQ(change.turning, std::sqrt(13.0) + 0.1 * 6.0);
  pass_joint(Joint{true, 5.0}, 0.1, 0.0, change);  // adds no rotation, but earlier joints rotate its axis
  EXPECT_EQ(change.point, 2.0 * 5.0 * change.turning);
}

TEST(Displacements, BoundHowCloseGroupsAndPairsOfThemCome) {
  double tightest = 0.0, tightest_pair = 0.0;
  detail::RelativeMotions motions;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed + 9000);
    // Every fifth model has few groups of many points; their largest speeds are computed point by point.
    Bodies<Point> plain = bodies(seed % 5 == 0 ? random_tree<Point>(random, 5, 40) : random_tree<Point>(random), 0.1);
    const auto& model = plain.model();
    std::vector<double> from(plain.dof_count()), to(from);
    for (double& q : from) q = random.uniform(-pi, pi);
    for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[k] + random.uniform(-2.0, 2.0);
    detail::GroupRates rates(model);
    rates.begin(StraightPath(from, to, from.size()));
    plain.update(state(from, to, 0.5));
    rates.set_middle(plain.frames());
    detail::Displacements displacements;
    displacements.begin(rates.groups());
    const double half = random.uniform(0.001, 0.3);
    displacements.find(rates.groups(), half);
    motions.forget();
    const auto placed = plain.placed();
    const std::vector<Point> middle(placed.begin(), placed.end());
    for (double t = 0.5 - half; t <= 0.5 + half; t += half / 5) {
      plain.update(state(from, to, t));
      const auto now = plain.placed();
      for (std::size_t i = 0; i < now.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          const auto of = [&](std::size_t k) {
            return displacements.of_groups()[index(model.group_of(id<PrimitiveId>(k)))] / rates.scale();
          };
          const double closer = distance(middle[i], middle[j]) - distance(now[i], now[j]);
          ASSERT_LE(closer, of(i) + of(j) + 1e-12) << i << ' ' << j;
          tightest = std::max(tightest, closer / (of(i) + of(j) + 1e-12));
          const std::size_t g = index(model.group_of(id<PrimitiveId>(i))),
                            h = index(model.group_of(id<PrimitiveId>(j)));
          const detail::RelativeMotion& motion =
              motions(rates.groups(), static_cast<std::uint32_t>(g), static_cast<std::uint32_t>(h), half);
          const double bound = approach(motion, rates.groups()[g], rates.groups()[h], half) / rates.scale();
          ASSERT_LE(closer, bound + 1e-12) << i << ' ' << j;
          tightest_pair = std::max(tightest_pair, closer / (bound + 1e-12));
        }
    }
  }
  EXPECT_GT(tightest, 0.7);
  EXPECT_GT(tightest_pair, 0.7);
}

TEST(SampledPath, LooksNoFartherApartThanItSays) {
  Bodies<Point> plain = slider(0.5);
  const PathAnswer answer = check_sampled(plain, std::vector{4.0}, std::vector{1.0}, 0.25);
  EXPECT_TRUE(answer.is_free());
  EXPECT_EQ(answer.counts.configurations, 13U);
  EXPECT_EQ(answer.counts.segments, 12U);
  // From one side of the collision to the other: a sampling finds it only with a state inside.
  const std::vector from{-1.3}, to{1.7};
  EXPECT_TRUE(check_sampled(plain, from, to, 4.0).is_free());
  const PathAnswer found = check_sampled(plain, from, to, 1.5);
  EXPECT_EQ(found.verdict, PathVerdict::colliding);
  EXPECT_EQ(found.parameter, 0.5);
  EXPECT_NEAR(found.configuration.at(0), 0.2, 1e-15);
  EXPECT_TRUE(found.hit.has_value());
  // The ends of the path are states as well.
  EXPECT_EQ(check_sampled(plain, std::vector{0.0}, std::vector{3.0}, 1.0).parameter, 0.0);
  EXPECT_EQ(check_sampled(plain, std::vector{3.0}, std::vector{0.0}, 1.0).parameter, 1.0);
  EXPECT_EQ(check_sampled(plain, std::vector{3.0}, std::vector{3.0}, 1.0).counts.configurations, 1U);
}

TEST(Paths, RefuseWhatIsNoPath) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), most = std::numeric_limits<double>::max();
  Bodies<Capsule> plain = arm_above_floor(0.0);
  CertifiedPath certified(plain);
  const std::vector q{0.0};
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message([&] {
              certified.check(q, std::vector{0.0, 1.0});
            }).find("end of the path has 2 values, expected 1"),
            std::string::npos);
  EXPECT_NE(message([&] { certified.check(std::vector{nan}, q); }).find("start of the path: value 0 is nan"),
            std::string::npos);
  EXPECT_NE(message([&] { certified.check(std::vector{-most}, std::vector{most}); }).find("difference"),
            std::string::npos);
  EXPECT_NE(message([&] { certified.check(q, q, 0.0); }).find("smallest step"), std::string::npos);
  EXPECT_NE(message([&] { certified.check(q, q, nan); }).find("smallest step"), std::string::npos);
  for (const double resolution : {0.0, -1.0, nan, 1e-300})
    EXPECT_NE(message([&] { check_sampled(plain, q, std::vector{1.0}, resolution); }).find("resolution"),
              std::string::npos);
}

}  // namespace certified_path_test
}  // namespace hinge
