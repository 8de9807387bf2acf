// SPDX-License-Identifier: BSD-3-Clause
// Tests reading of SRDF files: disabled pairs, groups, states, unknown names, rejected input.
#include "hinge/robotics/read_srdf.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "robotics/robots.hpp"

namespace hinge::robotics {
namespace read_srdf_test {

/// Two fingers on a rotating hand: root -turn- hand -left- l, hand -right- r (a mimic joint). l -tip- t is fixed.
Robot hand() {
  RobotDescription robot;
  robot.name = "hand robot";
  for (const char* name : {"root", "hand", "l", "r", "t"}) robot.links.push_back({name, {{BoxShape{}}}});
  const auto add = [&](const std::string& name, JointType type, const std::string& parent, const std::string& child) {
    JointDescription joint;
    joint.name = name;
    joint.type = type;
    joint.parent = parent;
    joint.child = child;
    robot.joints.push_back(joint);
  };
  add("turn", JointType::continuous, "root", "hand");
  add("left", JointType::prismatic, "hand", "l");
  add("right", JointType::prismatic, "hand", "r");
  add("tip", JointType::fixed, "l", "t");
  robot.joints[2].mimic = Mimic{"left"};
  return Robot(robot);
}

std::string srdf_of(const std::string& body) { return "<robot name='hand robot'>\n" + body + "</robot>\n"; }

Srdf read(const std::string& body, UnknownLinks unknown = UnknownLinks::refused) {
  const test::TemporaryFolder folder;
  Srdf srdf = read_srdf(folder.write("r.srdf", srdf_of(body)), hand(), unknown);
  for (std::string& note : srdf.notes) note.erase(0, folder.path().string().size() + 1);
  return srdf;
}

std::string refusal(const std::string& body) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("r.srdf", srdf_of(body));
  return test::refusal(folder, [&] { read_srdf(file, hand()); });
}

TEST(ReadSrdf, ReadsDisabledPairs) {
  const Srdf srdf = read(
      "<disable_collisions link1='r' link2='root' reason='Never'/>\n<disable_collisions link1='root' link2='r'/>\n"
      "<virtual_joint name='v' type='floating' parent_frame='w' child_link='root'/>\n");
  EXPECT_EQ(srdf.disabled.size(), 1U);
  const Robot robot = hand();
  EXPECT_TRUE(srdf.disabled.contains(*robot.find_link("root"), *robot.find_link("r")));
  EXPECT_TRUE(srdf.notes.empty());
}

TEST(ReadSrdf, SwitchesWholeLinksOffAndPairsOnAgain) {
  const Srdf srdf = read("<enable_collisions link1='t' link2='root'/>\n<disable_default_collisions link='t'/>\n");
  EXPECT_EQ(srdf.disabled.size(), 3U);
  const Robot robot = hand();
  EXPECT_FALSE(srdf.disabled.contains(*robot.find_link("root"), *robot.find_link("t")));
}

TEST(ReadSrdf, RefusesUnknownLinksUnlessTheyAreToBeNoted) {
  const std::string body = "<disable_collisions link1='l' link2='r'/>\n<disable_collisions link1='l' link2='ghost'/>\n";
  EXPECT_EQ(refusal(body),
            "r.srdf:3: <disable_collisions> names link 'ghost', which robot 'hand robot' does not have"
            "; --note-unknown-links skips such pairs");
  const Srdf srdf = read(body, UnknownLinks::noted);
  EXPECT_EQ(srdf.disabled.size(), 1U);
  EXPECT_EQ(srdf.notes,
            (std::vector<std::string>{
                "r.srdf: 1 pairs name links that the robot does not have; the first is line 3, link 'ghost'"}));
}

TEST(ReadSrdf, ResolvesGroupsToJoints) {
  const Srdf srdf = read(
      "<group name='by joint'><joint name='right'/><joint name='tip'/></group>\n"
      "<group name='by link'><link name='hand'/><link name='t'/></group>\n"
      "<group name='chain'><chain base_link='root' tip_link='t'/></group>\n"
      "<group name='across'><chain base_link='r' tip_link='t'/></group>\n"
      "<group name='all'><group name='chain'/><group name='by joint'/></group>\n");
  ASSERT_EQ(srdf.groups.size(), 5U);
  EXPECT_EQ(srdf.groups[0].joints, (std::vector<std::size_t>{2}));
  EXPECT_EQ(srdf.groups[1].joints, (std::vector<std::size_t>{0}));
  EXPECT_EQ(srdf.groups[2].joints, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(srdf.groups[3].joints, (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(srdf.groups[4].joints, (std::vector<std::size_t>{0, 1, 2}));
}

TEST(ReadSrdf, ReadsNamedConfigurations) {
  const Srdf srdf = read(
      "<group name='g'><joint name='turn'/></group>\n"
      "<group_state name='open' group='g'><joint name='left' value='0.04'/><joint name='right' value='9'/>"
      "<joint name='tip' value='0 0 0 0 0 0 1'/><joint name='world_joint' value='0 0 0'/></group_state>\n");
  ASSERT_EQ(srdf.configurations.size(), 1U);
  EXPECT_EQ(srdf.configurations[0].name, "open");
  std::vector<double> q = {1.5, 2.5};
  srdf.configurations[0].apply(q);
  EXPECT_EQ(q, (std::vector<double>{1.5, 0.04}));
  EXPECT_EQ(srdf.notes,
            (std::vector<std::string>{"r.srdf:3: joint 'world_joint': unknown, left out of groups and states"}));
}

/// The virtual joint of the file is a known name, so groups and states that contain it cause no note.
TEST(ReadSrdf, PassesOverItsVirtualJoints) {
  const Srdf srdf = read(
      "<virtual_joint name='world_joint' type='floating' parent_frame='odom' child_link='root'/>\n"
      "<group name='g'><joint name='world_joint'/><joint name='turn'/></group>\n"
      "<group_state name='up' group='g'><joint name='world_joint' value='0 0 0 0 0 0 1'/><joint name='turn' value='1'/>"
      "</group_state>\n");
  EXPECT_TRUE(srdf.notes.empty());
  EXPECT_EQ(srdf.groups.at(0).joints.size(), 1U);
  EXPECT_EQ(srdf.configurations.at(0).values.size(), 1U);
}

TEST(ReadSrdf, RefusesWhatItCannotResolve) {
  EXPECT_EQ(refusal("<group name='g'><group name='g'/></group>\n"), "r.srdf:2: group 'g' contains itself");
  EXPECT_EQ(refusal("<group_state group='g'/>\n"), "r.srdf:2: <group_state> has no attribute 'name'");
  EXPECT_EQ(refusal("<group_state name='s' group='g'>\n<joint name='turn' value='nan'/></group_state>\n"),
            "r.srdf:3: joint 'turn' has value \"nan\", expected one finite number of at most 1e15");
  EXPECT_EQ(refusal("<disable_collisions link1='l'/>\n"), "r.srdf:2: <disable_collisions> has no attribute 'link2'");
  EXPECT_EQ(refusal("<group>\n"), "r.srdf:2: is not XML: XML_ERROR_MISMATCHED_ELEMENT");
}

// No verdict depends on groups. SRDF files for several variants of a robot name links that some variants lack.
TEST(ReadSrdf, NotesWhatGroupsAndStatesDoNotFind) {
  const Srdf chain = read("<group name='g'><chain base_link='x' tip_link='t'/><joint name='turn'/></group>\n");
  EXPECT_EQ(chain.groups.at(0).joints, (std::vector<std::size_t>{0}));
  EXPECT_EQ(chain.notes, (std::vector<std::string>{"r.srdf:2: link 'x': unknown, left out of groups, together with "
                                                   "the chains that end at it"}));
  const Srdf subgroup = read("<group name='g'><group name='h'/><joint name='turn'/></group>\n");
  EXPECT_EQ(subgroup.groups.at(0).joints, (std::vector<std::size_t>{0}));
  EXPECT_EQ(subgroup.notes, (std::vector<std::string>{"r.srdf:2: subgroup 'h': unknown, left out of groups"}));
  EXPECT_EQ(read("<group name='g'><link name='x'/></group>\n").notes.size(), 1U);
}

/// The SRDF files of Kinova contain states without a group.
TEST(ReadSrdf, KeepsAStateWithoutAGroupUnderItsName) {
  const Srdf srdf = read("<group_state name='home'><joint name='turn' value='0.5'/></group_state>\n");
  ASSERT_EQ(srdf.configurations.size(), 1U);
  EXPECT_EQ(srdf.configurations[0].full_name(), "home");
  EXPECT_EQ(srdf.configurations[0].values.at(0).second, 0.5);
  EXPECT_TRUE(srdf.notes.empty());
}

TEST(ReadSrdf, TakesTheLastOfTwoValuesWithANote) {
  const Srdf srdf = read(
      "<group_state name='s' group='g'><joint name='turn' value='1'/>\n<joint name='turn' value='2'/></group_state>\n");
  std::vector<double> q = {0, 0};
  srdf.configurations.at(0).apply(q);
  EXPECT_EQ(q[0], 2.0);
  EXPECT_EQ(srdf.notes,
            (std::vector<std::string>{"r.srdf:3: joint 'turn': given twice in a state, the last value is used"}));
}

TEST(ReadSrdf, SaysOneCauseOnce) {
  std::string states;
  for (const char* name : {"s", "t"}) {
    states += std::string("<group_state name='") + name + "' group='g'>\n";
    for (const char* joint : {"a", "b", "c"}) states += std::string("<joint name='") + joint + "' value='0'/>\n";
    states += "</group_state>\n";
  }
  EXPECT_EQ(read(states).notes,
            (std::vector<std::string>{"r.srdf:3: joint 'a' and 2 more: unknown, left out of groups and states"}));
}

TEST(ReadSrdf, NotesAnotherRobotsName) {
  const test::TemporaryFolder folder;
  const Srdf srdf = read_srdf(folder.write("r.srdf", "<robot name='foot'/>"), hand());
  ASSERT_EQ(srdf.notes.size(), 1U);
  EXPECT_TRUE(srdf.notes[0].ends_with("r.srdf: the file is for robot 'foot', but the robot is 'hand robot'"))
      << srdf.notes[0];
}

TEST(ReadLinkPairs, AddsTwoNamesALine) {
  const test::TemporaryFolder folder;
  const Robot robot = hand();
  LinkPairs pairs(robot.link_count());
  read_link_pairs(folder.write("p.txt", "# found by sampling\nl r\n\nroot t  # far\n"), robot, pairs);
  EXPECT_EQ(pairs.size(), 2U);
  const auto bad = folder.write("bad.txt", "l r\nl ghost\n");
  EXPECT_EQ(test::refusal(folder, [&] { read_link_pairs(bad, robot, pairs); }),
            "bad.txt:2: no link 'ghost' in robot 'hand robot'");
  const auto three = folder.write("three.txt", "l r t\n");
  EXPECT_EQ(test::refusal(folder, [&] { read_link_pairs(three, robot, pairs); }), "three.txt:1: 3 names, expected two");
}

}  // namespace read_srdf_test
}  // namespace hinge::robotics
