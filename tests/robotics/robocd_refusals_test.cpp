// SPDX-License-Identifier: BSD-3-Clause
// Tests input that robocd rejects: exit status 3 and one line that names file and element.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "robotics/run_robocd.hpp"

namespace hinge::robotics {
namespace robocd_refusals_test {

using test::ArmFolder;
using test::run_robocd;
using test::Said;

/// Returns the line on standard error without the folder's path; an explanation if the output is not such a line.
std::string refusal(const ArmFolder& arm, const std::string& arguments) {
  Said said = run_robocd(arguments + " 2>&1 >/dev/null");
  const std::string prefix = arm.path().string() + "/";
  for (std::size_t at = said.out.find(prefix); at != std::string::npos; at = said.out.find(prefix))
    said.out.erase(at, prefix.size());
  if (said.status != 3) return "status " + std::to_string(said.status) + ": " + said.out;
  if (!said.out.starts_with("robocd: ") || std::count(said.out.begin(), said.out.end(), '\n') != 1)
    return "not one line: " + said.out;
  return said.out.substr(8, said.out.size() - 9);
}

std::string csv_refusal(const std::string& text) {
  const ArmFolder arm;
  arm.write("q.csv", text);
  return refusal(arm, "check" + arm.urdf() + " --csv-in" + arm.file("q.csv"));
}

TEST(RobocdCsv, IsRefusedWithLineAndColumn) {
  EXPECT_EQ(csv_refusal(""), "q.csv: is empty, expected a header of joint names");
  EXPECT_EQ(csv_refusal("shoulder,elbow\n"), "q.csv: holds only a header, expected configurations below it");
  EXPECT_EQ(csv_refusal("shoulder\n0\n"), "q.csv:1: has no column for joint 'elbow'");
  EXPECT_EQ(csv_refusal("shoulder,elbwo,time\n0,0,0\n"),
            "q.csv:1: has no column for joint 'elbow'; columns without a known joint: 'elbwo', 'time'");
  EXPECT_EQ(csv_refusal("mount,elbow\n0,0\n"), "q.csv:1: column 1: joint 'mount' is fixed and takes no value");
  EXPECT_EQ(csv_refusal("shoulder,elbow,follower\n0,0,0\n"),
            "q.csv:1: column 3: joint 'follower' mimics joint 'elbow' and takes no value");
  EXPECT_EQ(csv_refusal("elbow,elbow\n0,0\n"), "q.csv:1: column 2: joint 'elbow' occurs twice");
  EXPECT_EQ(csv_refusal("elbow,shoulder\n0,0\n1,2,3\n"), "q.csv:3: 3 columns, expected 2");
  EXPECT_EQ(csv_refusal("elbow,shoulder\n0\n"), "q.csv:2: 1 columns, expected 2");
  EXPECT_EQ(csv_refusal("elbow,shoulder\n0,0\n\n0,0\n"),
            "q.csv:3: the line is blank, expected blank lines only at the end of the file");
  for (const char* value : {"nan", "inf", "", "1e999", "0x10", "1 2", "1.5x", "--1", "+-1"})
    EXPECT_EQ(
        csv_refusal(std::string("elbow,shoulder\n0,0\n0,") + value + "\n"),
        std::string("q.csv:3: column 2: joint 'shoulder' is '") + value + "', expected a finite number, at most 1e+15");
}

TEST(RobocdCsv, IsReadAsSpreadsheetsWriteIt) {
  const ArmFolder arm;
  arm.write("q.csv", "\xEF\xBB\xBF elbow , shoulder\r\n -1.4 ,+5e-1\r\n\r\n");
  EXPECT_EQ(run_robocd("check" + arm.urdf() + " --csv-in" + arm.file("q.csv") + " --out" + arm.file("back.csv")).status,
            1);
  EXPECT_EQ(run_robocd("check" + arm.urdf() + " --csv-in" + arm.file("back.csv") + " --csv").out,
            "index,collides,finding,first,second,distance,x1,y1,z1,x2,y2,z2\n"
            "0,1,pair,base,fore,,,,,,,\n0,1,pair,camera,mast,,,,,,,\n");
}

TEST(RobocdCsv, MayLeaveTheLimitsWithANote) {
  const ArmFolder arm;
  arm.write("q.csv", "elbow,shoulder\n2,0\n0,9\n");
  const Said said = run_robocd("check" + arm.urdf() + " --csv-in" + arm.file("q.csv") + " 2>&1 >/dev/null");
  EXPECT_EQ(said.status, 0);
  EXPECT_EQ(
      said.out,
      "note: 1 of 2 configurations are outside the joint limits: configuration 0 has 2 for joint 'elbow', limits -1.5 "
      "and 1\n");
}

TEST(RobocdCsv, MayHaveQuotesAndOtherColumns) {
  const ArmFolder arm;
  arm.write("plain.csv", "shoulder,elbow\n0.5,-1.4\n0.25,0\n");
  arm.write("q.csv", ",time,\"elbow\", \"shoulder\"\n0,\"now, or then\",-1.4,\"0.5\"\n1,,0,0.25\n");
  const std::string command = "check" + arm.urdf() + " --csv --csv-in";
  EXPECT_EQ(run_robocd(command + arm.file("q.csv")).out, run_robocd(command + arm.file("plain.csv")).out);
  const std::string note = run_robocd(command + arm.file("q.csv") + " 2>&1 >/dev/null").out;
  EXPECT_TRUE(note.ends_with("q.csv: columns without a known joint are left out: '', 'time'\n")) << note;
}

/// Returns the refusal of the arm after one replacement in its URDF.
std::string urdf_refusal(const std::string& from, const std::string& to) {
  const ArmFolder arm;
  std::string text = test::arm_urdf;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) return "no such text";
  arm.write("arm.urdf", text.replace(at, from.size(), to));
  return refusal(arm, "info" + arm.urdf());
}

/// Expects every word in the text.
void expect_words(const std::string& text, const std::vector<std::string>& words) {
  EXPECT_FALSE(text.starts_with("status") || text.starts_with("not one line") || text == "no such text") << text;
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
}

TEST(RobocdUrdf, IsRefusedNamingLineAndElement) {
  const std::string mesh = "<mesh filename=\"cube.stl\"/>";
  expect_words(urdf_refusal("cube.stl", "gone.stl"), {"arm.urdf:2: ", "'base'", "gone.stl", "there is no file"});
  expect_words(urdf_refusal("cube.stl", "package://there/cube.stl"),
               {"arm.urdf:2: ", "package", "no package folder is given"});
  expect_words(urdf_refusal(mesh, "<mesh filename=\"cube.stl\" scale=\"1 0 1\"/>"),
               {"arm.urdf:2: ", "'base'", "scale 1 0 1"});
  expect_words(urdf_refusal("lower=\"-1.5\"", "lower=\"nan\""), {"arm.urdf:8: ", "[elbow]", "nan"});
  expect_words(
      urdf_refusal("<parent link=\"base\"/><child link=\"upper\"/>", "<parent link=\"fore\"/><child link=\"upper\"/>"),
      {"arm.urdf:4: ", "'fore'", "form a cycle"});
  expect_words(urdf_refusal("<child link=\"mast\"/>", "<child link=\"fore\"/>"),
               {"arm.urdf:11: ", "'follower'", "'fore'"});
  expect_words(urdf_refusal("<child link=\"mast\"/>", "<child link=\"mars\"/>"), {"arm.urdf:11: ", "'mars'"});
  expect_words(urdf_refusal("radius=\"0.0625\"", "radius=\"-1\""), {"arm.urdf:5: ", "'camera'", "radius -1"});
  expect_words(urdf_refusal("joint=\"elbow\" mult", "joint=\"knee\" mult"), {"arm.urdf:11: ", "'follower'", "'knee'"});
  expect_words(urdf_refusal("</robot>", ""), {"arm.urdf:", "is not XML"});
  expect_words(urdf_refusal("type=\"continuous\"", "type=\"floating\""), {"arm.urdf:7: ", "'shoulder'", "floating"});
}

TEST(RobocdUrdf, AsksForXacroToBeRunFirst) {
  expect_words(urdf_refusal("<link name=\"upper\">", "<xacro:include/><link name=\"upper\">"),
               {"arm.urdf:3: ", "xacro"});
  expect_words(urdf_refusal("0.0625", "${r}"), {"arm.urdf:5: ", "xacro"});
  const ArmFolder arm;
  arm.write("arm.urdf.xacro", test::arm_urdf);
  EXPECT_EQ(refusal(arm, "info" + arm.file("arm.urdf.xacro")),
            "arm.urdf.xacro: is a xacro file: run `xacro FILE > FILE.urdf` first and read its output");
}

TEST(RobocdFiles, ThatAreMissingOrDamagedAreRefused) {
  const ArmFolder arm;
  expect_words(refusal(arm, "info" + arm.file("gone.urdf")), {"gone.urdf", "cannot be opened"});
  expect_words(refusal(arm, "info '" + arm.path().string() + "/'"), {"is a directory"});
  const std::string info = "info" + arm.urdf(), zero = "check" + arm.urdf() + " --zero";
  expect_words(refusal(arm, info + " --srdf" + arm.file("gone.srdf")), {"gone.srdf", "cannot be opened"});
  expect_words(refusal(arm, zero + " --env" + arm.file("gone.stl")), {"gone.stl"});
  expect_words(refusal(arm, "check" + arm.urdf() + " --csv-in" + arm.file("gone.csv")),
               {"gone.csv", "cannot be opened"});
  arm.write("skip.txt", "base fore\nbase nobody\n");
  EXPECT_EQ(refusal(arm, info + " --skip-pairs" + arm.file("skip.txt")),
            "skip.txt:2: 'nobody' is neither a link of robot 'arm' nor a body of --env");
  arm.write("bad.srdf", "<robot name=\"arm\">\n<disable_collisions link1=\"base\" link2=\"nobody\"/>\n</robot>\n");
  expect_words(refusal(arm, info + " --srdf" + arm.file("bad.srdf")), {"bad.srdf:2: ", "'nobody'"});
  const Said noted = run_robocd(info + " --note-unknown-links --srdf" + arm.file("bad.srdf") + " 2>&1 >/dev/null");
  EXPECT_EQ(noted.status, 0);
  expect_words(noted.out,
               {"note: ", "bad.srdf: 1 pairs name links that the robot does not have", "line 2, link 'nobody'"});

  const std::string cube = test::cube_stl(Vec3::Zero(), 0.125);
  for (const auto& [bytes, words] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {cube.substr(0, cube.size() - 7), {"cube.stl"}},
           {cube.substr(0, 80) + std::string(4, '\0'), {"cube.stl"}},
           {"", {"cube.stl"}},
           {cube.substr(0, 96) + std::string("\0\0\xc0\x7f", 4) + cube.substr(100), {"cube.stl"}}}) {
    arm.write("cube.stl", bytes);
    expect_words(refusal(arm, info), {"arm.urdf:2: ", "'base'"});
    expect_words(refusal(arm, info), words);
    expect_words(refusal(arm, zero + " --env" + arm.file("cube.stl")), words);
  }
}

TEST(RobocdFiles, ThatAreMissingMayBeSkippedAndAreSaidToBe) {
  const ArmFolder arm;
  std::string text = test::arm_urdf;
  arm.write("arm.urdf", text.replace(text.find("cube.stl"), 8, "gone.stl"));
  expect_words(refusal(arm, "info" + arm.urdf()), {"gone.stl", "--missing-meshes skip"});
  const std::string skip = arm.urdf() + " --missing-meshes skip";
  const Said said = run_robocd("check" + skip + " --zero 2>&1");
  EXPECT_EQ(said.status, 0) << said.out;
  expect_words(said.out, {"note: ", "link 'base': 1 of 1 <collision> left out: mesh 'gone.stl'",
                          "configuration 0: free (incomplete model: 1 link lacks geometry)",
                          "0 of 1 configuration collides (incomplete model: 1 link lacks geometry)",
                          "note: incomplete model: geometry is missing and was not tested for: base"});
  expect_words(run_robocd("check" + skip + " --zero --json").out, {"\"incomplete_links\": [\n   \"base\"\n  ]"});
  expect_words(run_robocd("path" + skip + " --from zero --to zero").out, {"(incomplete model: 1 link lacks geometry)"});
  expect_words(run_robocd("matrix" + skip + " --samples 1 --cells 0").out,
               {"<!-- incomplete model: link base lacks geometry -->"});
}

TEST(RobocdUrdf, AsksWhereAFloatingBaseStandsInAnEnvironment) {
  const ArmFolder arm;
  std::string text = test::arm_urdf;
  const std::string world =
      "<link name=\"world\"/><joint name=\"free\" type=\"floating\"><parent link=\"world\"/><child link=\"base\"/>"
      "</joint></robot>";
  arm.write("arm.urdf", text.replace(text.find("</robot>"), 8, world));
  const std::string zero = "check" + arm.urdf() + " --zero";
  const Said self = run_robocd(zero + " 2>&1 >/dev/null");
  EXPECT_EQ(self.status, 0) << self.out;
  expect_words(self.out, {"note: ", "joint 'free' is floating and carries all geometry, so it is treated as fixed"});
  const std::string env = zero + " --env" + arm.file("cube.stl");
  const Said asked = run_robocd(env + " 2>&1");
  EXPECT_EQ(asked.status, 2);
  expect_words(asked.out, {"joint 'free'", "--floating-base fixed"});
  EXPECT_EQ(run_robocd(env + " --floating-base fixed").status,
            1);  // the path in the message is that of the base's cube
  EXPECT_EQ(run_robocd(env + " --floating-base free").status, 2);
}

TEST(RobocdFiles, AreFoundInPackages) {
  const ArmFolder arm;
  arm.write("share/arm_meshes/stl/cube.stl", test::cube_stl(Vec3::Zero(), 0.125));
  std::string text = test::arm_urdf;
  arm.write("arm.urdf", text.replace(text.find("cube.stl"), 8, "package://arm_meshes/stl/cube.stl"));
  EXPECT_EQ(run_robocd("info" + arm.urdf() + " --package-path" + arm.file("share")).status, 0);
  EXPECT_EQ(run_robocd("info" + arm.urdf() + " --package-path /nonexistent --package-path" + arm.file("share")).status,
            0);
  EXPECT_EQ(run_robocd("info" + arm.urdf(), "ROS_PACKAGE_PATH=" + (arm.path() / "share").string()).status, 0);
  EXPECT_EQ(run_robocd("info" + arm.urdf(), "AMENT_PREFIX_PATH=" + arm.path().string()).status, 0);
}

}  // namespace robocd_refusals_test
}  // namespace hinge::robotics
