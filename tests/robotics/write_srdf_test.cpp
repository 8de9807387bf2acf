// SPDX-License-Identifier: BSD-3-Clause
// Tests writing and merging of SRDF files: kinds of pairs, escaped names, kept text.
#include "hinge/robotics/write_srdf.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "hinge/robotics/read_srdf.hpp"
#include "robotics/robots.hpp"

namespace hinge::robotics {
namespace write_srdf_test {

/// Seven links in a chain, with names that XML must escape.
Robot awkward_robot() {
  RobotDescription robot{"a \"robot\" & <co>", {}, {}};
  for (const char* name : {"a", "b--c", "<d>", "e & 'f'", "\"g\"", "h-", "i"}) {
    robot.links.push_back({name, {{BoxShape{}}}});
    if (robot.links.size() == 1) continue;
    JointDescription joint;
    joint.name = std::string("to ") + name;
    joint.type = JointType::continuous;
    joint.parent = robot.links[robot.links.size() - 2].name;
    joint.child = name;
    robot.joints.push_back(joint);
  }
  return Robot(robot);
}

CollisionMatrix every_kind() {
  CollisionMatrix matrix;
  const PairKind kinds[] = {PairKind::adjacent,  PairKind::always, PairKind::in_default,
                            PairKind::sometimes, PairKind::never,  PairKind::unseen};
  std::size_t k = 0;
  for (std::size_t a = 1; a <= 7; ++a)
    for (std::size_t b = a + 1; b <= 7; ++b, ++k) {
      MatrixEntry entry{id<LinkId>(a), id<LinkId>(b), kinds[k % 6], 100, k % 6, 17, {}};
      if (k % 2 == 0) entry.smallest_gap = 0.25;
      matrix.entries.push_back(entry);
    }
  return matrix;
}

std::string text(const LinkPairs& pairs) {
  std::string line;
  for (const auto& [a, b] : pairs.list()) line += std::to_string(index(a)) + "-" + std::to_string(index(b)) + " ";
  return line;
}

std::string written(const Robot& robot, const CollisionMatrix& matrix, UnseenPairs unseen) {
  std::ostringstream out;
  write_srdf(robot, matrix, out, unseen);
  return out.str();
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(WriteSrdf, ReadingBackGivesTheSameDisabledPairs) {
  const Robot robot = awkward_robot();
  const CollisionMatrix matrix = every_kind();
  const test::TemporaryFolder folder;
  for (const UnseenPairs unseen : {UnseenPairs::tested, UnseenPairs::disabled}) {
    const auto file = folder.write("robot.srdf", written(robot, matrix, unseen));
    const Srdf srdf = read_srdf(file, robot);
    EXPECT_EQ(text(srdf.disabled), text(disabled_pairs(robot, matrix, unseen)));
    EXPECT_TRUE(srdf.notes.empty());
  }
  EXPECT_LT(disabled_pairs(robot, matrix).size(), disabled_pairs(robot, matrix, UnseenPairs::disabled).size());
}

TEST(WriteSrdf, SaysNeverOnlyOfProvedPairs) {
  const Robot robot = awkward_robot();
  const CollisionMatrix matrix = every_kind();  // 21 pairs: 4 of each of the first three kinds, 3 of each other
  const std::string safe = written(robot, matrix, UnseenPairs::tested);
  EXPECT_EQ(count(safe, "reason=\"Adjacent\""), 4U);
  EXPECT_EQ(count(safe, "reason=\"Always\""), 4U);
  EXPECT_EQ(count(safe, "reason=\"Default\""), 4U);
  EXPECT_EQ(count(safe, "reason=\"Never\"/>  <!-- proved"), 3U);
  EXPECT_EQ(count(safe, "reason=\"Never\""), 3U);
  EXPECT_EQ(count(safe, "NotSeen"), 0U);
  EXPECT_EQ(count(safe, "<!-- tested: "), 6U);
  const std::string all = written(robot, matrix, UnseenPairs::disabled);
  EXPECT_EQ(count(all, "reason=\"NotSeen\"/>  <!-- not seen in 100 samples, not proved with 17 boxes"), 3U);
  EXPECT_EQ(count(all, "reason=\"Never\""), 3U);
}

TEST(WriteSrdf, SaysHowOftenAPairWasSeen) {
  CollisionMatrix matrix;
  matrix.entries.push_back({id<LinkId>(1), id<LinkId>(3), PairKind::sometimes, 1000, 3, 0, {}});
  matrix.entries.push_back({id<LinkId>(1), id<LinkId>(4), PairKind::sometimes, 1000, 0, 9, 0.0});
  matrix.entries.push_back({id<LinkId>(1), id<LinkId>(5), PairKind::always, 1000, 1000, 0, {}});
  matrix.entries.push_back({id<LinkId>(2), id<LinkId>(4), PairKind::in_default, 1000, 5, 0, {}});
  matrix.entries.push_back({id<LinkId>(2), id<LinkId>(5), PairKind::never, 1000, 0, 1, 0.125});
  const std::string text = written(awkward_robot(), matrix, UnseenPairs::tested);
  for (const char* expected :
       {"in 3 of 1000 samples -->", "in 0 of 1000 samples, and in a configuration found by search",
        "in 1000 of 1000 samples", "in the default configuration and 5 of 1000 samples",
        "proved within the limits, 1 box of joint values, smallest gap computed 0.125 m"})
    EXPECT_EQ(count(text, expected), 1U) << expected << " in\n" << text;
}

TEST(MergeSrdf, KeepsWhatTheFileHasAndAddsTheRest) {
  const Robot robot = awkward_robot();
  const test::TemporaryFolder folder;
  // Pairs in the order of every_kind(): 1-2 adjacent, 1-3 always, 1-4 in default, 1-5 sometimes, 1-6 never, 1-7 unseen.
  const std::string file =
      "<?xml version='1.0'?>\n<!-- mine </robot> -->\n<robot name='a \"robot\" &amp; &lt;co>'>\n"
      "  <group name='arm'><joint name='to i'/></group>\n"
      "  <group_state name='up' group='arm'><joint name='to i' value='1'/></group_state>\n"
      "  <enable_collisions link1='a' link2='&lt;d>'/>\n"
      "  <disable_collisions link1='a' link2='\"g\"' reason='User: cables'/>\n"
      "  <disable_collisions link2='a' link1='h-' reason='Never'/>\n";
  const std::string end = "</robot>\n<!-- the end: </robot> -->\n";
  const auto path = folder.write("mine.srdf", file + end);
  const Srdf before = read_srdf(path, robot);
  EXPECT_EQ(text(before.enabled), "1-3 ");
  for (const UnseenPairs unseen : {UnseenPairs::tested, UnseenPairs::disabled}) {
    std::ostringstream out;
    merge_srdf(path, before, robot, every_kind(), out, unseen);
    EXPECT_TRUE(out.str().starts_with(file));
    EXPECT_TRUE(out.str().ends_with(end));
    EXPECT_EQ(count(out.str(), "<!-- disabled above, but seen in collision: a and &quot;g&quot;: in 3 of 100"), 1U);
    EXPECT_EQ(count(out.str(), "<!-- tested, because enabled above: a and &lt;d&gt;: Always, in 1 of 100 samples"), 1U);
    EXPECT_EQ(count(out.str(), "a and h-"), 0U);
    const Srdf after = read_srdf(folder.write("merged.srdf", out.str()), robot);
    LinkPairs expected = disabled_pairs(robot, every_kind(), unseen);
    expected.erase(id<LinkId>(1), id<LinkId>(3));
    expected.insert(id<LinkId>(1), id<LinkId>(5));
    EXPECT_EQ(text(after.disabled), text(expected));
    EXPECT_EQ(after.groups.size(), 1U);
    ASSERT_EQ(after.configurations.size(), 1U);
    EXPECT_EQ(after.configurations[0].full_name(), "arm/up");
  }
  // The SRDF has an empty <robot>.
  std::ostringstream out;
  const auto empty = folder.write("empty.srdf", "<robot name='r'/>");
  merge_srdf(empty, read_srdf(empty, robot), robot, every_kind(), out);
  EXPECT_EQ(out.str(), written(robot, every_kind(), UnseenPairs::tested));
}

}  // namespace write_srdf_test
}  // namespace hinge::robotics
