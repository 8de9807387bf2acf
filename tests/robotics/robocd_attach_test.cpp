// SPDX-License-Identifier: BSD-3-Clause
// Tests robocd --attach: a body that a link holds moves with it, in every command, with verdicts by plain geometry.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "robotics/run_robocd.hpp"

namespace hinge::robotics {
namespace robocd_attach_test {

using Json = nlohmann::json;
using test::ArmFolder;
using test::run_robocd;
using test::Said;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A ball of radius 0.1 m, 0.4 m above the origin of the link fore, which is 1.5 m + elbow from the axis of the
/// shoulder.
const std::string held =
    " --env 'ball=sphere:0.1,xyz=0 0 0.4' --attach fore ball --allow camera ball --allow mast ball";
/// A post of radius 0.3 m at x = 1.5, y = 0.5, above all links but the camera, which may touch it.
const std::string post = " --env 'post=cylinder:0.3 0.2,xyz=1.5 0.5 0.4' --allow camera post --allow mast post";

TEST(RobocdAttach, MovesTheBodyWithItsLink) {
  const ArmFolder folder;
  const Said said = run_robocd("check" + folder.urdf() + held + post + " --random 400 --seed 3 --json 2>/dev/null");
  ASSERT_LE(said.status, 1) << said.out;
  const Json all = Json::parse(said.out);
  EXPECT_EQ(all.at("attached"), Json::parse(R"([{"link": "fore", "body": "ball"}])"));
  std::size_t hits = 0;
  for (const Json& row : all.at("configurations")) {
    const double shoulder = row.at("values")[0], reach = 1.5 + row.at("values")[1].get<double>();
    const double x = reach * std::cos(shoulder) - 1.5, y = reach * std::sin(shoulder) - 0.5;
    const double gap = std::sqrt(x * x + y * y) - 0.3;  // of the ball's centre to the post, at the same height
    if (std::abs(gap - 0.1) < 2e-3) continue;           // cylinders enclose to a millimetre
    bool found = false;
    for (const Json& pair : row.at("environment_pairs"))
      if (pair.at("body") == "post" && pair.contains("held")) {
        EXPECT_EQ(pair.at("link"), "fore");
        EXPECT_EQ(pair.at("held"), "ball");
        found = true;
      }
    EXPECT_EQ(found, gap < 0.1) << row;
    hits += found ? 1U : 0U;
  }
  EXPECT_GT(hits, 3U);
  // Without --attach the ball stands in the world, and CSV names it.
  const Said alone =
      run_robocd("check" + folder.urdf() + " --env 'ball=sphere:0.1,xyz=0 0 0.4'" + post + " --zero --json");
  EXPECT_FALSE(has(alone.out, "held"));
  const Said csv = run_robocd("check" + folder.urdf() + held + post + " --random 400 --seed 3 --csv 2>/dev/null");
  EXPECT_TRUE(has(csv.out, ",environment_pair,ball,post,")) << csv.out.substr(0, 400);
}

TEST(RobocdAttach, WorksInPathsPagesAndParts) {
  const ArmFolder folder;
  const std::string robot = folder.urdf() + held + post;
  // The ball passes the post between shoulder 0 and 0.6; the links do not.
  const Said path = run_robocd("path" + robot + " --from 0,0.08 --to 0.6,0.08 --json 2>/dev/null");
  EXPECT_EQ(path.status, 1) << path.out;
  EXPECT_TRUE(has(path.out, "\"held\"") && has(path.out, "post")) << path.out;
  EXPECT_EQ(run_robocd("path" + robot + " --from 0,0.9 --to 0.2,0.9 2>/dev/null").status, 0);
  const std::string page = (folder.path() / "page.html").string();
  EXPECT_LE(run_robocd("check" + robot + " --random 20 --report " + page + " 2>/dev/null").status, 1);
  const std::string asked = "check" + robot + " --random 300 --json", parts = (folder.path() / "parts").string();
  EXPECT_EQ(run_robocd(asked + " --unit 40 --parts " + parts + " 2>/dev/null").status, 0);
  EXPECT_TRUE(run_robocd("merge " + parts).out == run_robocd(asked + " 2>/dev/null").out);
}

TEST(RobocdAttach, RefusesWhatDoesNotFit) {
  const ArmFolder folder;
  const std::string start = "check" + folder.urdf() + " --zero --env 'ball=sphere:0.1' ";
  for (const auto& [words, reason] : std::vector<std::pair<std::string, std::string>>{
           {"--attach hand ball", "robot 'arm' has no link 'hand'"},
           {"--attach fore cup", "'cup' is not a body of --env"},
           {"--attach fore ball --attach upper ball", "link 'fore' holds the body already"}}) {
    const Said said = run_robocd(start + words + " 2>&1");
    EXPECT_EQ(said.status, 2);
    EXPECT_TRUE(has(said.out, reason)) << said.out;
  }
}

}  // namespace robocd_attach_test
}  // namespace hinge::robotics
