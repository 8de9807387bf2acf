// SPDX-License-Identifier: BSD-3-Clause
// Tests what robocd prints for people: tables, lists that are cut, --exit-zero, and the picture of the demo.
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "robotics/run_robocd.hpp"

namespace hinge::robotics {
namespace robocd_output_test {

using Json = nlohmann::json;
using test::run_robocd;
using test::Said;

const std::string data = HINGE_SOURCE_DIR "/robotics/data/";
const std::string arm = " " + data + "arm.urdf --srdf " + data + "arm.srdf ";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(RobocdTables, HaveUnitsAndSingulars) {
  EXPECT_TRUE(has(run_robocd("check" + arm + "--state arm/reach --mode closest").out,
                  "configuration 0: free\n"
                  "  link                         link or body                 distance (m)\n"
                  "  left_finger                  right_finger                         0.06  (closest)\n"
                  "0 of 1 configuration collides\n"));
  const Said path = run_robocd("path" + arm + "--from state:arm/home --to state:arm/reach --env " + data + "shelf.obj");
  EXPECT_TRUE(has(path.out, "collides at t = 0.8804\n  link                         link or body\n  wrist    "))
      << path.out;
  const Said info = run_robocd("info" + arm);
  EXPECT_TRUE(has(info.out, "grip                                 prismatic         -0.02         0.02 m\n"))
      << info.out;
  EXPECT_TRUE(has(info.out, "\n21 pairs of links tested:\n"));
}

TEST(RobocdMaxPairs, CutsTablesAndIfGivenJsonAndCsv) {
  const std::string within = "check" + arm + "--zero --mode within:0.3 ";
  const Json whole = Json::parse(run_robocd(within + "--json").out)["configurations"][0];
  const Json cut = Json::parse(run_robocd(within + "--json --max-pairs 2").out)["configurations"][0];
  const std::size_t left_out = whole["pairs"].size() - 2;
  ASSERT_GT(left_out, 0U);
  EXPECT_FALSE(whole.contains("pairs_left_out"));
  EXPECT_EQ(cut["pairs"].size(), 2U);
  EXPECT_EQ(cut["pairs_left_out"], left_out);
  const Said table = run_robocd(within + "--max-pairs 2");
  EXPECT_TRUE(has(table.out, "  ... and " + std::to_string(left_out) + " more; --max-pairs all lists them\n"))
      << table.out;
  const Said csv = run_robocd(within + "--csv --max-pairs 2 2>&1");
  EXPECT_TRUE(has(csv.out, "note: --max-pairs 2: " + std::to_string(left_out) + " pair")) << csv.out;
  EXPECT_FALSE(has(run_robocd(within + "--max-pairs all").out, "more;"));
}

TEST(RobocdExitZero, HidesVerdictsButNoErrors) {
  const std::string path = "path" + arm + "--from state:arm/home --to state:arm/reach --env " + data + "shelf.obj ";
  for (const std::string& command : {path, "check" + arm + "--random 200 "}) {
    EXPECT_EQ(run_robocd(command).status, 1) << command;
    EXPECT_EQ(run_robocd(command + "--exit-zero").status, 0) << command;
  }
  const test::ArmFolder folder;
  const std::string undecided = "path" + folder.urdf() + " --from 0,0.9 --to 3.1,-1.3 --min-step 1 ";
  EXPECT_EQ(run_robocd(undecided).status, 4);
  EXPECT_EQ(run_robocd(undecided + "--exit-zero").status, 0);
  EXPECT_EQ(run_robocd("check /nonexistent --zero --exit-zero 2>/dev/null").status, 3);
  EXPECT_EQ(run_robocd("check" + arm + "--exit-zero 2>/dev/null").status, 2);
}

std::string content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(RobocdDemo, DrawsThePictureOfReadme) {
  const test::ArmFolder folder;
  const std::filesystem::path svg = folder.path() / "robot.svg", png = folder.path() / "robot.png";
  const std::string motion =
      "demo" + arm + "--from state:arm/home --to state:arm/reach --env shelf=" + data + "shelf.obj";
  const Said said = run_robocd(motion + " --out " + svg.string());
  EXPECT_EQ(said.status, 0) << said.out;
  EXPECT_TRUE(has(said.out, "brute force on 100 of them: 0 differences\n")) << said.out;
  EXPECT_TRUE(has(said.out, "collides at t = 0.8804\n  wrist                        shelf\n")) << said.out;
  EXPECT_TRUE(content(svg) == content(HINGE_SOURCE_DIR "/docs/images/robot.svg")) << "copy the new picture";
  EXPECT_EQ(run_robocd(motion + " --out " + png.string() + " 2>/dev/null").status, 2);
  EXPECT_FALSE(std::filesystem::exists(png));
}

}  // namespace robocd_output_test
}  // namespace hinge::robotics
