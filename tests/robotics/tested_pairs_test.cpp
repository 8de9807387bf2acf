// SPDX-License-Identifier: BSD-3-Clause
// Tests which pairs of links are tested by default.
#include "hinge/robotics/tested_pairs.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {
namespace tested_pairs_test {

/// Chain a -r- b -f- c -r- d -r- e (r: revolute, f: fixed). Link d has no geometry.
Robot chain() {
  RobotDescription robot;
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    robot.links.push_back({name, {}});
    if (*name != 'd') robot.links.back().geometry.push_back({BoxShape{}});
  }
  for (std::size_t k = 0; k + 1 < robot.links.size(); ++k) {
    JointDescription joint;
    joint.name = "to " + robot.links[k + 1].name;
    joint.type = k == 1 ? JointType::fixed : JointType::continuous;
    joint.parent = robot.links[k].name;
    joint.child = robot.links[k + 1].name;
    robot.joints.push_back(joint);
  }
  return Robot(robot);
}

std::string text(const Robot& robot, const LinkPairs& pairs) {
  std::string line;
  for (const auto& [a, b] : pairs.list()) line += robot.link_name(a) + robot.link_name(b) + " ";
  return line;
}

TEST(TestedPairs, LeaveOutRigidGroupsNeighboursAndLinksWithoutGeometry) {
  const Robot robot = chain();
  EXPECT_EQ(text(robot, tested_pairs(robot)), "ae be ce ");
}

TEST(TestedPairs, LeaveOutDisabledPairsWhicheverWayRound) {
  const Robot robot = chain();
  LinkPairs disabled(robot.link_count());
  disabled.insert(*robot.find_link("e"), *robot.find_link("b"));
  EXPECT_EQ(text(robot, tested_pairs(robot, disabled)), "ae ce ");
  EXPECT_THROW(tested_pairs(robot, LinkPairs(3)), ModelError);
}

TEST(LinkPairFilter, AdmitsTrianglesByTheirLinks) {
  const Robot robot = chain();
  const LinkPairFilter filter(robot, tested_pairs(robot));
  ASSERT_EQ(filter.size(), 48U);
  const auto links = robot.model().links();
  for (std::size_t i = 0; i < filter.size(); ++i)
    for (std::size_t j = 0; j < filter.size(); ++j) {
      const std::set<std::string> names = {robot.link_name(links[i]), robot.link_name(links[j])};
      EXPECT_EQ(filter.admits(id<PrimitiveId>(i), id<PrimitiveId>(j)), names.contains("e") && names.size() == 2);
    }
}

TEST(LinkPairFilter, AnswersForGroupsOfLinksAtOnce) {
  const Robot robot = chain();
  LinkPairs disabled(robot.link_count());
  disabled.insert(*robot.find_link("b"), *robot.find_link("e"));
  const LinkPairFilter filter(robot, tested_pairs(robot, disabled));
  const std::vector<LinkId> a = {*robot.find_link("a")}, bc = {*robot.find_link("b"), *robot.find_link("c")},
                            e = {*robot.find_link("e")};
  using Admission = LinkPairFilter::Admission;
  EXPECT_EQ(filter.between(a, bc), Admission::none);
  EXPECT_EQ(filter.between(a, e), Admission::all);
  EXPECT_EQ(filter.between(bc, e), Admission::some);
}

TEST(LinkPairs, AreASymmetricSet) {
  LinkPairs pairs(130);
  const LinkId a = id<LinkId>(3), b = id<LinkId>(129);
  pairs.insert(b, a);
  pairs.insert(a, b);
  pairs.insert(a, a);
  EXPECT_EQ(pairs.size(), 1U);
  EXPECT_TRUE(pairs.contains(a, b) && pairs.contains(b, a));
  EXPECT_FALSE(pairs.contains(a, a));
  EXPECT_EQ(pairs.list(), (std::vector<std::pair<LinkId, LinkId>>{{a, b}}));
  pairs.erase(a, b);
  EXPECT_EQ(pairs.size(), 0U);
  EXPECT_FALSE(pairs.contains(b, a));
  EXPECT_THROW(pairs.insert(a, id<LinkId>(130)), ModelError);
}

}  // namespace tested_pairs_test
}  // namespace hinge::robotics
