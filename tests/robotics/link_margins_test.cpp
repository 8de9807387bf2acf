// SPDX-License-Identifier: BSD-3-Clause
// Tests LinkMargins: radii and clearances of links as thresholds.
#include "hinge/robotics/link_margins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/policy/laws.hpp"
#include "robotics/random_robot.hpp"

namespace hinge::robotics {
namespace link_margins_test {

constexpr std::uint64_t seed = 20251;

Robot random_robot(std::uint64_t number) {
  SampleStream stream(seed, number);
  return Robot(test::random_description(stream, 7));
}

std::string refusal(const Robot& robot, double clearance, const std::vector<PairClearance>& overrides = {}) {
  try {
    const LinkMargins margins(robot, clearance, overrides);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

TEST(LinkMargins, AddRadiiAndTheClearanceOfTheLinks) {
  const Robot robot = random_robot(0);
  ASSERT_EQ(robot.radii().size(), robot.model().size());
  const LinkId a = *robot.find_link("link1"), b = *robot.find_link("link4");
  const std::vector<PairClearance> overrides = {{b, a, 0.25}};
  const LinkMargins margins(robot, 0.03125, overrides);
  ASSERT_EQ(margins.size(), robot.model().size());
  bool overridden = false, grown = false;
  for (std::size_t i = 0; i < margins.size(); ++i)
    for (std::size_t j = 0; j < margins.size(); ++j) {
      const LinkId k = robot.model().links()[i], l = robot.model().links()[j];
      const bool named = (k == a && l == b) || (k == b && l == a);
      overridden = overridden || named;
      grown = grown || robot.radii()[i] > 0.0;
      EXPECT_EQ(margins.threshold(id<PrimitiveId>(i), id<PrimitiveId>(j)),
                robot.radii()[i] + robot.radii()[j] + (named ? 0.25 : 0.03125));
    }
  EXPECT_TRUE(overridden && grown);
}

TEST(LinkMargins, KeepTheLawsOfDistanceMatrices) {
  SCOPED_TRACE(seed);
  for (std::uint64_t number = 0; number < 20; ++number) {
    const Robot robot = random_robot(number);
    SampleStream stream(seed + 1, number);
    std::vector<PairClearance> overrides;
    for (std::size_t l = 2; l < robot.link_count(); ++l)
      overrides.push_back({id<LinkId>(1), id<LinkId>(l), stream.uniform() < 0.3 ? 0.0 : stream.uniform()});
    for (const LinkMargins& margins :
         {LinkMargins(robot), LinkMargins(robot, stream.uniform()), LinkMargins(robot, stream.uniform(), overrides)})
      EXPECT_EQ(laws::check_distance_matrix(margins, robot.model().size()), laws::Violations{});
  }
}

TEST(LinkMargins, AreCoveredByReachesBetweenModelsOfOtherClearances) {
  SCOPED_TRACE(seed);
  for (std::uint64_t number = 0; number < 20; ++number) {
    const Robot robot = random_robot(2 * number), other = random_robot(2 * number + 1);
    SampleStream stream(seed + 2, number);
    const LinkMargins margins(robot, stream.uniform()), others(other, number % 3 == 0 ? 0.0 : stream.uniform());
    ASSERT_TRUE(margins.compatible(others));
    for (std::size_t i = 0; i < margins.size(); ++i)
      for (std::size_t j = 0; j < others.size(); ++j) {
        const auto a = id<PrimitiveId>(i), b = id<PrimitiveId>(j);
        const double m = margins.threshold(a, others, b);
        EXPECT_EQ(m, others.threshold(b, margins, a));
        EXPECT_NEAR(m, robot.radii()[i] + other.radii()[j] + (margins.clearance() + others.clearance()) / 2, 1e-15);
        EXPECT_GE(margins.reach(a) + others.reach(b), m);
      }
  }
}

TEST(LinkMargins, AreZeroWhenNothingIsAskedOfThem) {
  SampleStream stream(seed, 99);
  RobotDescription description{"plain", {{"a"}, {"b"}}, {}};
  for (LinkDescription& link : description.links)
    link.geometry.push_back({MeshShape{test::random_mesh(stream, 2, 1.0)}});
  JointDescription joint{"j", JointType::continuous, "a", "b"};
  description.joints.push_back(joint);
  const Robot robot(description);
  const LinkMargins margins(robot);
  EXPECT_EQ(margins.threshold(id<PrimitiveId>(0), id<PrimitiveId>(3)), 0.0);
  EXPECT_EQ(margins.reach(id<PrimitiveId>(0)), 0.0);
  EXPECT_EQ(margins.radius(id<PrimitiveId>(0)), 0.0);
}

TEST(LinkMargins, RefuseClearancesThatAreNoLengths) {
  const Robot robot = random_robot(0);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal(robot, -0.5), "clearance of all links is -0.5: expected a finite length >= 0");
  EXPECT_NE(refusal(robot, infinity), "");
  EXPECT_NE(refusal(robot, std::numeric_limits<double>::quiet_NaN()), "");
  const LinkId a = *robot.find_link("link1"), b = *robot.find_link("link2");
  EXPECT_EQ(refusal(robot, 0.0, {{a, b, -1.0}}),
            "clearance of links 'link1' and 'link2' is -1: expected a finite length >= 0");
  EXPECT_NE(refusal(robot, 0.0, {{a, b, infinity}}), "");
}

TEST(LinkMargins, RefusePairsThatAreNone) {
  const Robot robot = random_robot(0);
  const LinkId a = *robot.find_link("link1"), b = *robot.find_link("link2");
  EXPECT_EQ(refusal(robot, 0.0, {{a, a, 0.1}}), "clearance of links 'link1' and 'link1': expected two different links");
  EXPECT_EQ(refusal(robot, 0.0, {{a, b, 0.1}, {b, a, 0.1}}), "clearance of links 'link2' and 'link1' is given twice");
  EXPECT_EQ(refusal(robot, 0.0, {{a, id<LinkId>(8), 0.1}}),
            "clearance of links: the robot has no link 8, expected 1 to 7");
  EXPECT_NE(refusal(robot, 0.0, {{world, a, 0.1}}), "");
}

}  // namespace link_margins_test
}  // namespace hinge::robotics
