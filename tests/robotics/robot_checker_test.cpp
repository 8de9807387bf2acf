// SPDX-License-Identifier: BSD-3-Clause
// Tests RobotChecker with every engine against brute force: verdicts, distances, touching, containment.
#include "hinge/robotics/robot_checker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "extremes/refusal.hpp"
#include "hinge/core/error.hpp"
#include "robotics/random_robot.hpp"
#include "robotics/robots.hpp"

namespace hinge::robotics {
namespace robot_checker_test {

constexpr std::uint64_t seed = 7781;
using Pairs = std::set<std::pair<LinkId, LinkId>>;

const double nan = std::numeric_limits<double>::quiet_NaN();

Pairs pairs_of(const std::vector<LinkContact>& contacts) {
  Pairs pairs;
  for (const LinkContact& contact : contacts) EXPECT_TRUE(pairs.emplace(contact.link1, contact.link2).second);
  return pairs;
}

std::shared_ptr<const Robot> random_robot(std::uint64_t number, std::size_t links = 7) {
  SampleStream stream(seed, number);
  return std::make_shared<const Robot>(test::random_description(stream, links));
}

/// Two unit cubes. The second slides along x and touches the first at 1.
RobotDescription slider(const Shape& first = BoxShape{}, const Shape& second = BoxShape{}) {
  RobotDescription robot{"slider", {{"fixed", {{first}}}, {"between"}, {"sliding", {{second}}}}, {}};
  JointDescription joint{"turn", JointType::continuous, "fixed", "between"};
  robot.joints.push_back(joint);
  joint = {"slide", JointType::prismatic, "between", "sliding"};
  robot.joints.push_back(joint);
  return robot;
}

RobotChecker slider_checker(const RobotDescription& description, double clearance = 0.0,
                            const std::string& engine = "simd") {
  const auto robot = std::make_shared<const Robot>(description);
  return {robot, tested_pairs(*robot), LinkMargins(*robot, clearance), {engine}};
}

class EveryEngine : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, EveryEngine, testing::Values("simd", "lazy", "brute"),
                         [](const auto& engine) { return engine.param; });

/// Compares every answer with all pairs of inflated triangles; Eigen computes the poses.
TEST_P(EveryEngine, AgreesWithAllPairsOneByOne) {
  SCOPED_TRACE(seed);
  std::size_t colliding = 0, free = 0;
  for (std::uint64_t number = 0; number < 25; ++number) {
    SampleStream stream(seed + 1, number);
    const auto robot = random_robot(number, 4 + number % 6);
    const LinkPairs tested = tested_pairs(*robot);
    const double clearance = number % 2 == 0 ? 0.0 : 0.05;
    std::vector<PairClearance> overrides;
    if (number % 3 == 2) overrides.push_back({id<LinkId>(1), id<LinkId>(4), 0.2});
    const LinkMargins margins(*robot, clearance, overrides);
    RobotChecker checker(robot, tested, margins, {GetParam()});
    for (int c = 0; c < 8; ++c) {
      const std::vector<double> q = test::random_configuration(*robot, stream);
      checker.update(q);
      const auto links = test::grown_triangles(*robot, q);
      Pairs hits, near;
      std::size_t triangles = 0;
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [a, b] : tested.list()) {
        const double m = margins.clearance(a, b);
        for (const test::Grown& x : links[index(a)])
          for (const test::Grown& y : links[index(b)]) {
            const double gap = test::apart(x, y) - m;
            triangles += gap < 0.0 || (m == 0.0 && gap == 0.0) ? 1U : 0U;
            if (gap < 0.0 || (m == 0.0 && gap == 0.0)) hits.emplace(a, b);
            if (gap < 0.1) near.emplace(a, b);
            least = std::min(least, gap);
          }
      }
      EXPECT_EQ(checker.collides(), !hits.empty());
      EXPECT_EQ(pairs_of(checker.colliding_links()), hits);
      EXPECT_EQ(pairs_of(checker.within(0.1)), near);
      EXPECT_EQ(checker.triangle_pairs().size(), triangles);
      const auto closest = checker.closest();
      ASSERT_EQ(closest.has_value(), std::isfinite(least));
      if (!closest) continue;
      EXPECT_EQ(closest->collides(), !hits.empty());
      EXPECT_NEAR(closest->gap, least, 1e-12);
      EXPECT_NEAR(std::sqrt(squared_norm(Vec3(closest->point1 - closest->point2))), closest->distance, 1e-12);
      const double m = margins.clearance(closest->link1, closest->link2);
      EXPECT_NEAR(closest->distance, std::max(0.0, least + m), 1e-12);
      // Each point is on the surface of its link, or inside both links if they overlap.
      const auto off = [&](LinkId link, const Vec3& point) {
        return test::apart(links[index(link)], {{{point, point, point}, 0.0}});
      };
      EXPECT_LE(off(closest->link1, closest->point1), 1e-12);
      EXPECT_LE(off(closest->link2, closest->point2), 1e-12);
      (hits.empty() ? free : colliding)++;
    }
  }
  EXPECT_GT(colliding, 20U);
  EXPECT_GT(free, 20U);
}

/// Some of the first 256 yes/no queries calibrate the order of pairs, and each query tries the last hit's pair first.
TEST(RobotChecker, AnswersYesOrNoAlikeBeforeAndAfterItKnowsAnOrder) {
  SCOPED_TRACE(seed);
  for (std::uint64_t number = 0; number < 4; ++number) {
    SampleStream stream(seed + 2, number);
    const auto robot = random_robot(number, 10);
    const LinkPairs tested = tested_pairs(*robot);
    RobotChecker checker(robot, tested, LinkMargins(*robot)), brute(robot, tested, LinkMargins(*robot), {"brute"});
    std::size_t colliding = 0;
    for (int k = 0; k < 320; ++k) {
      const std::vector<double> q = test::random_configuration(*robot, stream);
      checker.update(q);
      brute.update(q);
      ASSERT_EQ(checker.collides(), brute.collides()) << "robot " << number << ", configuration " << k;
      colliding += brute.collides() ? 1U : 0U;
    }
    EXPECT_GT(colliding, 0U);
    EXPECT_LT(colliding, 320U);
  }
}

/// Balls of radii r and s at centre distance x touch or overlap if and only if x <= r + s, with the exact sum.
TEST_P(EveryEngine, LetsGrownShapesMeetWhenTheyTouchAndNotBefore) {
  SCOPED_TRACE(seed);
  SampleStream stream(seed + 9, 0);
  std::size_t exact_sums = 0, touching = 0;
  const auto check = [&](double r, double s, double x, bool expected) {
    RobotChecker checker = slider_checker(slider(SphereShape{r}, SphereShape{s}), 0.0, GetParam());
    for (const char* mode : {"any", "all", "within:0.1", "closest"})
      EXPECT_EQ(checker.check(std::vector<double>{0.0, x}, Mode::parse(mode)).collides, expected)
          << mode << ", " << r << ' ' << s << ' ' << x;
    const auto closest = checker.closest();
    ASSERT_TRUE(closest.has_value());
    EXPECT_EQ(closest->distance == 0.0, expected);
    EXPECT_EQ(closest->collides(), expected);
  };
  check(0.1, 0.1, 0.2, true);
  check(0.1, 0.1, std::nextafter(0.2, 1.0), false);
  check(0.1, 0.2, 0.3, true);
  check(0.1, 0.2, 0.1 + 0.2, false);  // the double sum is rounded up
  for (int k = 0; k < 40; ++k) {
    const double r = stream.uniform(), s = k % 4 == 0 ? r : stream.uniform(), x = r + s;
    // The exact rounding error of the sum (Knuth's two-sum).
    const double b = x - r, left_out = (r - (x - b)) + (s - b);
    exact_sums += left_out == 0.0 ? 1 : 0;
    touching += left_out >= 0.0 ? 1 : 0;
    check(r, s, x, left_out >= 0.0);
    check(r, s, std::nextafter(x, 10.0), false);
    check(r, s, std::nextafter(x, 0.0), true);
  }
  EXPECT_GE(exact_sums, 10U);
  EXPECT_LT(touching, 40U);
}

/// With a clearance c the criterion is strict: d < r + s + c.
TEST_P(EveryEngine, AddsClearancesToRadiiWithoutRounding) {
  const auto collides = [&](double r, double s, double c, double x) {
    RobotChecker checker = slider_checker(slider(SphereShape{r}, SphereShape{s}), c, GetParam());
    checker.update(std::vector<double>{0.0, x});
    return checker.collides();
  };
  EXPECT_FALSE(collides(0.25, 0.25, 0.5, 1.0));
  EXPECT_TRUE(collides(0.25, 0.25, 0.5, std::nextafter(1.0, 0.0)));
  EXPECT_TRUE(collides(0.5, 0.25, 0.25 + 0x1p-54, 1.0)) << "a sum above 1 that rounds to 1";
}

TEST_P(EveryEngine, AnswersEveryModeAlike) {
  SCOPED_TRACE(seed);
  for (std::uint64_t number = 0; number < 6; ++number) {
    SampleStream stream(seed + 2, number);
    const auto robot = random_robot(number);
    RobotChecker checker(robot, tested_pairs(*robot), LinkMargins(*robot), {GetParam()});
    for (int c = 0; c < 5; ++c) {
      const std::vector<double> q = test::random_configuration(*robot, stream);
      const Verdict all = checker.check(q, Mode::parse("all"));
      const Verdict any = checker.check(q, Mode::parse("any"));
      const Verdict within = checker.check(q, Mode::parse("within:0.1"));
      const Verdict closest = checker.check(q, Mode::parse("closest"));
      EXPECT_EQ(all.collides, !all.pairs.empty());
      EXPECT_EQ(any.collides, all.collides);
      EXPECT_EQ(within.collides, all.collides);
      EXPECT_EQ(closest.collides, all.collides);
      EXPECT_TRUE(any.pairs.empty() && closest.pairs.empty() && !all.closest);
      const Pairs few = pairs_of(all.pairs), more = pairs_of(within.pairs);
      EXPECT_TRUE(std::includes(more.begin(), more.end(), few.begin(), few.end()));
      EXPECT_TRUE(std::is_sorted(within.pairs.begin(), within.pairs.end(), [](const auto& x, const auto& y) {
        return std::pair(x.link1, x.link2) < std::pair(y.link1, y.link2);
      }));
    }
  }
}

TEST_P(EveryEngine, TouchesAtDistanceZeroAndNotAnUlpBefore) {
  RobotChecker checker = slider_checker(slider(), 0.0, GetParam());
  checker.update(std::vector<double>{0.0, 1.0});
  EXPECT_TRUE(checker.collides());
  EXPECT_EQ(checker.closest()->distance, 0.0);
  EXPECT_EQ(checker.closest()->point1, checker.closest()->point2);
  checker.update(std::vector<double>{0.0, std::nextafter(1.0, 2.0)});
  EXPECT_FALSE(checker.collides());
  EXPECT_FALSE(checker.closest()->collides());
  EXPECT_EQ(checker.closest()->distance, std::numeric_limits<double>::epsilon());
}

TEST_P(EveryEngine, TakesDistancesBelowTheClearanceOnly) {
  RobotChecker checker = slider_checker(slider(), 0.25, GetParam());
  checker.update(std::vector<double>{0.0, 1.25});
  EXPECT_FALSE(checker.collides());
  EXPECT_EQ(checker.closest()->gap, 0.0);
  EXPECT_EQ(checker.closest()->distance, 0.25);
  checker.update(std::vector<double>{0.0, std::nextafter(1.25, 1.0)});
  EXPECT_TRUE(checker.collides());
  EXPECT_LT(checker.closest()->gap, 0.0);
  EXPECT_LT(checker.closest()->distance, 0.25);
}

/// Balls of radii 0.3 and 0.1: neither radius is exact, so verdicts near x = 0.4 depend on rounding but must agree.
TEST_P(EveryEngine, NeverContradictsItselfWhereBallsTouch) {
  RobotChecker checker = slider_checker(slider(SphereShape{0.3}, SphereShape{0.1}), 0.0, GetParam());
  double x = 0.4;
  for (int k = 0; k < 20; ++k) x = std::nextafter(x, 0.0);
  std::size_t hits = 0;
  for (int k = 0; k < 40; ++k, x = std::nextafter(x, 1.0)) {
    checker.update(std::vector<double>{0.0, x});
    const auto closest = checker.closest();
    EXPECT_EQ(checker.collides(), closest->collides());
    EXPECT_EQ(checker.collides(), closest->distance == 0.0);
    EXPECT_EQ(checker.collides(), closest->gap < 0.0);
    EXPECT_EQ(checker.collides(), !checker.colliding_links().empty());
    hits += checker.collides() ? 1U : 0U;
  }
  EXPECT_GT(hits, 10U);
  EXPECT_LT(hits, 30U);
  checker.update(std::vector<double>{0.0, 1.0});
  EXPECT_NEAR(checker.closest()->distance, 0.6, 1e-15);
  EXPECT_NEAR(checker.closest()->point1[0], 0.3, 1e-15);
  EXPECT_NEAR(checker.closest()->point2[0], 0.9, 1e-15);
}

TEST_P(EveryEngine, MovesWithItsBase) {
  SCOPED_TRACE(seed);
  SampleStream stream(seed + 3, 0);
  const auto robot = random_robot(3);
  RobotChecker still(robot, tested_pairs(*robot), LinkMargins(*robot), {GetParam()});
  RobotChecker moved = still;
  for (int c = 0; c < 10; ++c) {
    const std::vector<double> q = test::random_configuration(*robot, stream);
    const Pose base = test::random_pose(stream, 2.0);
    still.update(q);
    if (c % 2 == 0) moved.update(q);
    moved.set_base(base);
    if (c % 2 == 1) moved.update(q);
    EXPECT_EQ(moved.base(), base);
    EXPECT_EQ(pairs_of(moved.colliding_links()), pairs_of(still.colliding_links()));
    EXPECT_NEAR(moved.closest()->gap, still.closest()->gap, 1e-12);
    EXPECT_NEAR(squared_norm(Vec3(moved.closest()->point1 - base * still.closest()->point1)), 0.0, 1e-24);
    for (std::size_t l = 1; l < robot->link_count(); ++l)
      EXPECT_NEAR(squared_norm(Vec3(moved.link_pose(id<LinkId>(l)) * Vec3(1, 2, 3) -
                                    base * (still.link_pose(id<LinkId>(l)) * Vec3(1, 2, 3)))),
                  0.0, 1e-24);
  }
}

TEST_P(EveryEngine, MeetsAnotherRobotWhereAllPairsSay) {
  SCOPED_TRACE(seed);
  std::size_t colliding = 0, free = 0;
  for (std::uint64_t number = 0; number < 10; ++number) {
    SampleStream stream(seed + 4, number);
    const auto robot = random_robot(2 * number), other = random_robot(2 * number + 1, 5);
    // The larger of the two clearances counts.
    const double mine = number % 3 == 0 ? 0.0 : 0.03, theirs = number % 2 == 0 ? 0.0 : 0.07, m = std::max(mine, theirs);
    RobotChecker first(robot, tested_pairs(*robot), LinkMargins(*robot, mine), {GetParam()});
    RobotChecker second(other, tested_pairs(*other), LinkMargins(*other, theirs), {GetParam()});
    for (int c = 0; c < 6; ++c) {
      const std::vector<double> q = test::random_configuration(*robot, stream);
      const std::vector<double> r = test::random_configuration(*other, stream);
      const Pose base = test::random_pose(stream, 0.9);
      first.update(q);
      second.update(r);
      second.set_base(base);
      const auto a = test::grown_triangles(*robot, q), b = test::grown_triangles(*other, r, test::isometry(base));
      Pairs hits, near;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < a.size(); ++k)
        for (std::size_t l = 0; l < b.size(); ++l) {
          const double gap = test::apart(a[k], b[l]) - m;
          if (gap < 0.0 || (m == 0.0 && gap == 0.0)) hits.emplace(id<LinkId>(k), id<LinkId>(l));
          if (gap < 0.1) near.emplace(id<LinkId>(k), id<LinkId>(l));
          least = std::min(least, gap);
        }
      EXPECT_EQ(first.collides(second), !hits.empty());
      EXPECT_EQ(pairs_of(first.collisions(second)), hits);
      EXPECT_EQ(pairs_of(first.within(second, 0.1)), near);
      const auto closest = first.closest(second);
      ASSERT_TRUE(closest.has_value());
      EXPECT_NEAR(closest->gap, least, 1e-12);
      EXPECT_NEAR(closest->distance, std::max(0.0, least + m), 1e-12);
      EXPECT_EQ(closest->collides(), !hits.empty());
      EXPECT_EQ(second.collides(first), !hits.empty());
      (hits.empty() ? free : colliding)++;
    }
  }
  EXPECT_GT(colliding, 10U);
  EXPECT_GT(free, 10U);
}

TEST(RobotChecker, NamesLinksOnFixedJointsByThemselves) {
  RobotDescription description = slider();
  description.links.push_back({"flange", {{BoxShape{}}}});
  JointDescription mount{"mount", JointType::fixed, "sliding", "flange"};
  mount.origin.translation = {0, 0, 3};
  description.joints.push_back(mount);
  RobotChecker checker = slider_checker(description);
  checker.update(std::vector<double>{0.0, 0.5});
  const auto contacts = checker.colliding_links();
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(checker.robot().link_name(contacts[0].link1), "fixed");
  EXPECT_EQ(checker.robot().link_name(contacts[0].link2), "sliding");
  EXPECT_EQ(checker.link_pose(*checker.robot().find_link("flange")).translation, Vec3(0.5, 0, 3));
}

TEST(RobotChecker, CopiesAnswerForThemselves) {
  RobotChecker first = slider_checker(slider());
  first.update(std::vector<double>{0.0, 5.0});
  RobotChecker second = first;
  EXPECT_FALSE(second.collides());
  second.update(std::vector<double>{0.0, 0.5});
  EXPECT_TRUE(second.collides());
  EXPECT_FALSE(first.collides());
  EXPECT_EQ(first.colliding_links().size(), 0U);
  EXPECT_EQ(second.colliding_links().size(), 1U);
}

TEST(RobotChecker, KeepsItsStateWhenAConfigurationIsRefused) {
  for (const bool is_free : {false, true}) {
    RobotChecker checker = slider_checker(slider());
    if (is_free) checker.set_base(Pose{Mat3::Identity(), Vec3(0, 0, 1)});
    checker.update(std::vector<double>{0.0, 3.0});
    EXPECT_EQ(hinge::test::refusal<Error>([&] { checker.update(std::vector<double>{0.0}); }),
              "configuration has 1 values, expected 2, one for each independent joint");
    EXPECT_EQ(hinge::test::refusal<Error>([&] {
                checker.update(std::vector<double>{0.0, nan});
              }),
              "joint 'slide' is nan, expected a finite number");
    EXPECT_TRUE(hinge::test::refusal<Error>([&] {
                  checker.update(std::vector<double>{0.0, 1e301});
                }).starts_with("joint 'slide' takes the value"));
    EXPECT_THROW(checker.update(std::vector<double>{0.0, nan}), ConfigurationError);
    Pose bad = checker.base();
    bad.rotation *= 1.01;
    EXPECT_EQ(hinge::test::refusal<Error>([&] { checker.set_base(bad); }),
              "base of robot 'slider': not a rigid placement (finite, R R^T = 1, det 1)");
    EXPECT_THROW(checker.set_base(Pose{Mat3::Identity(), Vec3(nan, 0, 0)}), ConfigurationError);
    EXPECT_EQ(checker.closest()->distance, 2.0);
    EXPECT_EQ(checker.base().translation[2], is_free ? 1.0 : 0.0);
  }
}

TEST(RobotChecker, RefusesWhatDoesNotBelongTogether) {
  const auto robot = random_robot(0), other = random_robot(1, 5);
  const auto make = [&](const LinkPairs& pairs, const LinkMargins& margins, const std::string& engine) {
    return hinge::test::refusal<Error>([&] { const RobotChecker checker(robot, pairs, margins, {engine}); });
  };
  EXPECT_EQ(make(tested_pairs(*robot), LinkMargins(*robot), "simd"), "");
  EXPECT_EQ(make(tested_pairs(*robot), LinkMargins(*robot), "fast"), "engine 'fast': expected simd, lazy or brute");
  EXPECT_NE(make(tested_pairs(*other), LinkMargins(*robot), "simd"), "");
  EXPECT_NE(make(tested_pairs(*robot), LinkMargins(*other), "simd"), "");
  EXPECT_EQ(hinge::test::refusal<Error>([&] { RobotChecker(nullptr, LinkPairs(3), LinkMargins(*robot)); }),
            "robot checker: expected a robot, got none");

  RobotChecker checker(robot, tested_pairs(*robot), LinkMargins(*robot));
  EXPECT_NE(hinge::test::refusal<Error>([&] { checker.within(-0.1); }), "");
  EXPECT_NE(hinge::test::refusal<Error>([&] { checker.within(nan); }), "");
  EXPECT_NE(hinge::test::refusal<Error>([&] { checker.link_pose(id<LinkId>(8)); }), "");
  EXPECT_NE(hinge::test::refusal<Error>([&] { checker.collides(checker); }), "");
  RobotChecker brute(other, tested_pairs(*other), LinkMargins(*other), {"brute"});
  EXPECT_EQ(hinge::test::refusal<Error>([&] { checker.collides(brute); }),
            "a query between two models: they use different engines, expected one engine for both");
}

TEST(RobotChecker, HasNoClosestPairWhenNoneIsTested) {
  const auto robot = random_robot(0);
  RobotChecker checker(robot, LinkPairs(robot->link_count()), LinkMargins(*robot));
  EXPECT_FALSE(checker.closest().has_value());
  EXPECT_FALSE(checker.collides());
}

TEST(Mode, IsReadAndWritten) {
  for (const char* text : {"any", "all", "closest", "within:0.05", "within:0"})
    EXPECT_EQ(Mode::parse(text).text(), text);
  EXPECT_EQ(Mode::parse("within:1e-3").margin, 1e-3);
  for (const char* text : {"", "some", "within:", "within:x", "within:-1", "within:inf", "within:nan", "within:1 ",
                           "within: 1", "within:+1", "within:0x1", "within:1e", "within:1e400", "within:1,5"})
    EXPECT_THROW(Mode::parse(text), ModelError) << text;
}

PlacedShape cube(double size, const Vec3& at = Vec3::Zero()) {
  return {BoxShape{Vec3::Constant(size)}, Pose{Mat3::Identity(), at}};
}

TEST(Containment, OfLinksIsReportedWhereNothingTouches) {
  RobotDescription description = slider();
  auto hollow = std::make_shared<TriangleMesh>();
  hollow->triangles = tessellate(BoxShape{Vec3::Constant(4.0)}).triangles;
  description.links[0].geometry = {{MeshShape{hollow}}};
  description.links[2].geometry = {cube(1.0), cube(1.0, {0, 0, 3})};
  for (const std::string engine : {"simd", "lazy", "brute"}) {
    RobotChecker checker = slider_checker(description, 0.0, engine);
    EXPECT_TRUE(checker.not_closed().empty());
    EXPECT_FALSE(checker.collides());
    auto found = checker.contained();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(checker.robot().link_name(found[0].outer), "fixed");
    EXPECT_EQ(checker.robot().link_name(found[0].inner), "sliding");
    EXPECT_FALSE(found[0].whole);
    // Intersecting surfaces are a collision, not a containment.
    checker.update(std::vector<double>{0.0, 2.0});
    EXPECT_TRUE(checker.collides());
    EXPECT_TRUE(checker.contained().empty());
    checker.update(std::vector<double>{0.0, 9.0});
    EXPECT_TRUE(checker.contained().empty());
  }
  description.links[2].geometry.pop_back();
  RobotChecker checker = slider_checker(description);
  ASSERT_EQ(checker.contained().size(), 1U);
  EXPECT_TRUE(checker.contained()[0].whole);
}

TEST(Containment, IsNotLookedForInOpenLinksWhichAreNamed) {
  RobotDescription description = slider();
  auto open = std::make_shared<TriangleMesh>();
  for (const Triangle& t : tessellate(BoxShape{Vec3::Constant(4.0)}).triangles) open->triangles.push_back(t);
  open->triangles.pop_back();
  description.links[0].geometry = {{MeshShape{open}}};
  RobotChecker checker = slider_checker(description);
  EXPECT_TRUE(checker.contained().empty());
  ASSERT_EQ(checker.not_closed().size(), 1U);
  EXPECT_EQ(checker.robot().link_name(checker.not_closed()[0].link), "fixed");
  EXPECT_NE(checker.not_closed()[0].edge.from, checker.not_closed()[0].edge.to);
}

}  // namespace robot_checker_test
}  // namespace hinge::robotics
