// SPDX-License-Identifier: BSD-3-Clause
// Tests robocd as a program: exit status, JSON, determinism, on a robot whose distances are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "robotics/run_robocd.hpp"

namespace hinge::robotics {
namespace robocd_test {

using Json = nlohmann::json;
using test::ArmFolder;
using test::run_robocd;
using test::Said;

std::string content(const std::filesystem::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::set<std::string> keys(const Json& object) {
  std::set<std::string> names;
  for (const auto& [key, value] : object.items()) names.insert(key);
  return names;
}

/// Returns "a b;c d;" for rows with two names.
std::string pairs(const Json& rows, const char* first = "link1", const char* second = "link2") {
  std::string text;
  for (const Json& row : rows) text += row.at(first).get<std::string>() + " " + row.at(second).get<std::string>() + ";";
  return text;
}

/// Returns the JSON of a check and expects its exit status.
Json check(const std::string& arguments, int status) {
  const Said said = run_robocd("check" + arguments + " --json");
  EXPECT_EQ(said.status, status) << arguments;
  return Json::parse(said.out);
}

TEST(Robocd, ExitsWithTheDocumentedStatus) {
  const ArmFolder arm;
  const std::string check_arm = "check" + arm.urdf(), srdf = " --srdf" + arm.file("arm.srdf");
  EXPECT_EQ(run_robocd(check_arm + " --zero").status, 0);
  EXPECT_EQ(run_robocd(check_arm + srdf + " --state slide/in").status, 1);
  EXPECT_EQ(run_robocd("info" + arm.urdf()).status, 0);
  EXPECT_EQ(run_robocd("--version").status, 0);
  EXPECT_EQ(run_robocd("--help").status, 0);
  for (const std::string& wrong :
       {std::string(), std::string("check"), std::string("frobnicate"), check_arm, check_arm + " --zero --random 3",
        check_arm + " --random 0", check_arm + " --random -1", check_arm + " --zero --seed 3",
        check_arm + " --zero --mode x", check_arm + " --zero --mode within:-1", check_arm + " --zero --engine x",
        check_arm + " --zero --clearance -1", check_arm + " --zero --clearance nan", check_arm + " --zero --json --csv",
        check_arm + " --zero --threads 0", check_arm + " --zero --primitives x", check_arm + srdf + " --state all/x",
        check_arm + " --state slide/in", "matrix" + arm.urdf() + " --clearance -1"})
    EXPECT_EQ(run_robocd(wrong + " 2>&1").status, 2) << wrong;
}

TEST(Robocd, InformsAboutLinksJointsAndPairs) {
  const ArmFolder arm;
  const Said said = run_robocd("info" + arm.urdf() + " --json --srdf" + arm.file("arm.srdf"));
  ASSERT_EQ(said.status, 0);
  const Json json = Json::parse(said.out);
  const Json& robot = json.at("robot");
  EXPECT_EQ(robot.at("name"), "arm");
  EXPECT_EQ(robot.at("links"), 5);
  EXPECT_EQ(robot.at("links_with_geometry"), 5);
  EXPECT_EQ(robot.at("dof"), 2);
  EXPECT_EQ(robot.at("movable_joints"), 3);
  EXPECT_EQ(robot.at("rigid_groups"), 4);
  EXPECT_EQ(robot.at("degenerate_triangles"), 0);
  EXPECT_EQ(robot.at("tested_pairs"), 4);
  EXPECT_EQ(robot.at("disabled_pairs"), 1);
  EXPECT_EQ(pairs(json.at("tested_pairs")), "base fore;upper mast;fore mast;camera mast;");

  std::string links;
  for (const Json& link : json.at("links")) {
    EXPECT_EQ(keys(link),
              (std::set<std::string>{"name", "group", "triangles", "degenerate_triangles", "rounded", "closed"}));
    links += link["name"].get<std::string>() + " " + link["triangles"].dump() + " " + link["rounded"].dump() + " " +
             link["group"].dump() + " " + link["closed"].dump() + ";";
  }
  EXPECT_EQ(links, "base 12 0 0 true;upper 12 0 1 true;fore 12 0 2 true;camera 1 1 2 true;mast 12 0 3 true;");
  const Json& follower = json.at("joints").at(3);
  EXPECT_EQ(follower.at("name"), "follower");
  EXPECT_EQ(follower.at("mimic"), (Json{{"joint", "elbow"}, {"multiplier", 0.5}, {"offset", 0.25}}));
  EXPECT_EQ(json["joints"][1].at("lower"), -1.5);
  EXPECT_TRUE(json["joints"][0].at("upper").is_null()) << "a continuous joint has no limits";
  EXPECT_EQ(json.at("states").at(0), (Json{{"state", "all/turned"}, {"values", {{"shoulder", 0.5}, {"elbow", 0.25}}}}));
}

TEST(Robocd, TellsOpenAndDegenerateMeshes) {
  const ArmFolder arm;
  // Sets all corners of the cube's last triangle to (0, 0, 0).
  std::string bytes = test::cube_stl(Vec3::Zero(), 0.125);
  for (int k = 0; k < 36; ++k) bytes[bytes.size() - 38 + static_cast<std::size_t>(k)] = '\0';
  arm.write("cube.stl", bytes);
  const Json json = Json::parse(run_robocd("info" + arm.urdf() + " --json").out);
  EXPECT_EQ(json.at("links").at(0).at("closed"), false);
  EXPECT_EQ(json["links"][0].at("degenerate_triangles"), 1);
  EXPECT_EQ(json["links"][0].at("triangles"), 12);
}

TEST(Robocd, KnowsTheClosestPoints) {
  const ArmFolder arm;
  const Json json = check(arm.urdf() + " --zero --mode closest", 0);
  const Json& c = json.at("configurations").at(0);
  EXPECT_EQ(keys(c), (std::set<std::string>{"index", "collides", "values", "closest"}));
  const Json& closest = c["closest"];
  EXPECT_EQ(keys(closest), (std::set<std::string>{"link1", "link2", "distance", "point1", "point2"}));
  EXPECT_EQ(closest["link1"], "base");
  EXPECT_EQ(closest["link2"], "fore");
  EXPECT_EQ(closest["distance"], 1.5 - 0.0625 - 0.125);
  EXPECT_EQ(closest["point1"][0], 0.125);
  EXPECT_EQ(closest["point2"][0], 1.5 - 0.0625);
  EXPECT_EQ(closest["point1"][1], closest["point2"][1]);

  // Numbers have seventeen digits, so that they are read as the same double. sqrt(x^2 + y^2) of the rotated frame uses
  // all of them.
  const Json turned = check(arm.urdf() + " --srdf" + arm.file("arm.srdf") + " --state all/turned --mode closest", 0);
  const Json& far = turned["configurations"][0]["closest"];
  double squared = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
    squared += std::pow(far["point1"][k].get<double>() - far["point2"][k].get<double>(), 2);
  EXPECT_NEAR(far["distance"].get<double>(), std::sqrt(squared), 1e-15);
}

TEST(Robocd, KeepsTheJsonContractOfCheck) {
  const ArmFolder arm;
  arm.write("env.stl", test::cube_stl({0, 1.625, 0}, 0.125));
  const std::string in = arm.urdf() + " --srdf" + arm.file("arm.srdf") + " --state slide/in --mode ";
  const std::string env = " --env" + arm.file("env.stl");
  using Keys = std::set<std::string>;
  const auto row = [](const Json& json) { return json.at("configurations").at(0); };
  EXPECT_EQ(keys(row(check(in + "any", 1))), (Keys{"index", "collides", "values"}));
  EXPECT_EQ(keys(row(check(in + "any" + env, 1))), (Keys{"index", "collides", "values"}));
  EXPECT_EQ(keys(row(check(in + "all", 1))), (Keys{"index", "collides", "values", "pairs"}));
  EXPECT_EQ(keys(row(check(in + "within:0.1 --contained", 1))),
            (Keys{"index", "collides", "values", "pairs", "contained"}));
  EXPECT_EQ(keys(row(check(in + "all --contained" + env, 1))),
            (Keys{"index", "collides", "values", "pairs", "environment_pairs", "contained", "environment_contained"}));
  EXPECT_EQ(keys(row(check(in + "closest" + env, 1))),
            (Keys{"index", "collides", "values", "closest", "environment_closest"}));

  const Json json = check(in + "all" + env, 1);
  EXPECT_EQ(keys(json), (Keys{"tool", "command", "robot", "mode", "clearance", "seed", "environment", "allowed",
                              "attached", "notes", "joints", "configurations", "summary"}));
  EXPECT_EQ(keys(json["summary"]), (Keys{"checked", "colliding", "most_frequent"}));
  EXPECT_EQ(pairs(row(json)["pairs"]), "base fore;camera mast;");
  EXPECT_EQ(keys(row(json)["pairs"][0]), (Keys{"link1", "link2"}));
}

TEST(Robocd, ReportsPairsWithinAMarginAndAClearance) {
  const ArmFolder arm;
  const std::string zero = arm.urdf() + " --zero --mode ";
  EXPECT_EQ(pairs(check(zero + "all", 0)["configurations"][0]["pairs"]), "");
  EXPECT_EQ(pairs(check(zero + "within:1.3", 0)["configurations"][0]["pairs"]), "");
  EXPECT_EQ(pairs(check(zero + "within:1.32", 0)["configurations"][0]["pairs"]), "base fore;");
  EXPECT_EQ(pairs(check(zero + "all --clearance 1.32", 1)["configurations"][0]["pairs"]), "base fore;");
  EXPECT_EQ(check(zero + "any --clearance 1.32", 1)["configurations"][0]["collides"], true);
  EXPECT_EQ(check(zero + "closest --clearance 1.3", 0)["configurations"][0]["closest"]["distance"], 1.3125);
  // Pairs in a file for --skip-pairs are skipped like pairs in the SRDF.
  arm.write("skip.txt", "# the closest ones\nfore base\n");
  EXPECT_EQ(
      pairs(check(zero + "all --clearance 1.32 --skip-pairs" + arm.file("skip.txt"), 0)["configurations"][0]["pairs"]),
      "");
}

TEST(Robocd, AsksTheEnvironmentToo) {
  const ArmFolder arm;
  arm.write("env.stl", test::cube_stl({0, 1.625, 0}, 0.125));
  arm.write("room.stl", test::cube_stl({0, 0, 0}, 8));
  arm.write("q.csv", "elbow,shoulder\n0,0\n0,1.5707963267948966\n");
  const std::string rows = arm.urdf() + " --csv-in" + arm.file("q.csv");
  const std::string env = " --env" + arm.file("env.stl"), room = " --env" + arm.file("room.stl");
  const Json all = check(rows + env + " --mode all", 1)["configurations"];
  EXPECT_EQ(all[0]["collides"], false);
  EXPECT_EQ(all[1]["collides"], true);
  EXPECT_EQ(pairs(all[1]["pairs"]), "");
  const std::string name = (arm.path() / "env.stl").string();
  EXPECT_EQ(pairs(all[1]["environment_pairs"], "link", "body"), "fore " + name + ";");
  EXPECT_EQ(check(rows + env + " --mode any", 1)["configurations"][1]["collides"], true);
  // In the first row the base is nearest to the cube: from y = 0.125 to y = 1.5.
  const Json closest = check(rows + env + " --mode closest", 1)["configurations"];
  EXPECT_EQ(closest[0]["environment_closest"]["link"], "base");
  EXPECT_EQ(closest[0]["environment_closest"]["body"], name);
  EXPECT_EQ(closest[0]["environment_closest"]["distance"], 1.375);
  EXPECT_EQ(closest[1]["environment_closest"]["distance"], 0.0);
  EXPECT_EQ(closest[1]["collides"], true);
  const Json within = check(rows + env + " --mode within:1.38", 1)["configurations"];
  EXPECT_EQ(within[0]["collides"], false);
  EXPECT_EQ(pairs(within[0]["environment_pairs"], "link", "body"), "base " + name + ";");

  EXPECT_EQ(within[0]["environment_pairs"][0]["distance"], 1.375);
  EXPECT_EQ(within[0]["environment_pairs"][0]["point2"][1], 1.5);

  // A mesh around the robot is hollow, so nothing touches it.
  EXPECT_EQ(check(rows + room + " --mode all", 0)["configurations"][0]["collides"], false);
  const Json inside = check(rows + room + " --mode all --contained", 1)["configurations"][0];
  EXPECT_EQ(inside["collides"], true);
  EXPECT_EQ(inside["environment_contained"].size(), 5U);
  EXPECT_EQ(inside["environment_contained"][0]["inner"], "base");
}

TEST(Robocd, GivesDistancesWithinAMargin) {
  const ArmFolder arm;
  const Json row = check(arm.urdf() + " --zero --mode within:1.32", 0)["configurations"][0];
  EXPECT_EQ(row["values"], Json({0.0, 0.0}));
  EXPECT_EQ(row["pairs"][0]["distance"], 1.3125);
  EXPECT_EQ(row["pairs"][0]["point1"][0], 0.125);
  EXPECT_EQ(row["pairs"][0]["point2"][0], 1.4375);
}

TEST(Robocd, TakesPrimitivesPlacesAndNamesForBodies) {
  const ArmFolder arm;
  arm.write("unit.stl", test::cube_stl({0, 0, 0}, 1));
  const std::string zero = arm.urdf() + " --zero --mode ";
  const auto closest = [&](const std::string& body, int status = 0) {
    return check(zero + "closest --env '" + body + "'", status)["configurations"][0]["environment_closest"];
  };
  const std::string mesh = (arm.path() / "unit.stl").string();
  // Each body starts at y = 1.5. The base is the nearest link and ends at y = 0.125.
  for (const std::string& body :
       {std::string("it=box:0.25 0.25 0.25,xyz=0 1.625 0"), std::string("it=sphere:0.125,xyz=0 1.625 0"),
        std::string("it=cylinder:0.5 0.25,xyz=0 1.625 0,rpy=1.5707963267948966 0 0"),
        std::string("it=capsule:0.125 0.25,xyz=0 1.75 0,rpy=1.5707963267948966 0 0"),
        "it=" + mesh + ",scale=0.125,xyz=0 1.625 0", "it=" + mesh + ",xyz=0 1.625 0,scale=1 0.125 0.5"}) {
    const Json found = closest(body);
    EXPECT_EQ(found["body"], "it") << body;
    EXPECT_EQ(found["link"], "base") << body;
    EXPECT_NEAR(found["distance"].get<double>(), 1.375, 1e-12) << body;
  }
  EXPECT_EQ(closest("sphere:0.125,xyz=0 1.625 0")["body"], "sphere:0.125,xyz=0 1.625 0");
  for (const char* wrong : {"box:1 1", "box:1 1 x", "sphere:1,xyz=0 0", "sphere:1,scale=2", "sphere:1,xy=0 0 0",
                            "=sphere:1", "a=", "sphere:-1", "base=sphere:1", "sphere:1,xyz=0 0 nan"})
    EXPECT_EQ(run_robocd("check" + zero + "all --env '" + wrong + "' 2>&1").status, 2) << wrong;
  EXPECT_EQ(run_robocd("check" + zero + "all --env a=sphere:1 --env a=sphere:2 2>&1").status, 2);
  EXPECT_EQ(run_robocd("check" + zero + "all --env a=/nonexistent.stl 2>&1").status, 3);
}

/// A base stands on its table in every configuration.
TEST(Robocd, LeavesOutAllowedPairsOfLinkAndBody) {
  const ArmFolder arm;
  const std::string zero = "check" + arm.urdf() + " --zero --json";
  const std::string table = " --env 'table=box:0.5 0.5 0.25,xyz=0 0 -0.25'";
  const Said standing = run_robocd(zero + table + " 2>&1 >/dev/null");
  EXPECT_EQ(standing.status, 1);
  EXPECT_EQ(standing.out,
            "note: link 'base' never moves and collides with body 'table' in every configuration; --allow 'base' "
            "'table' leaves this pair out\n");
  const Said noted = run_robocd(zero + table + " 2>/dev/null");
  EXPECT_EQ(Json::parse(noted.out)["notes"].size(), 1U);
  EXPECT_EQ(Json::parse(noted.out)["environment"], Json({"table"}));
  arm.write("skip.txt", "table, base # it stands there\n");
  arm.write("wrong.txt", "fore base\ntable,legs\n");
  const std::string path = "path" + arm.urdf() + " --from zero --to 0.5,0.25";
  for (const std::string& allowed :
       {std::string(" --allow base table"), std::string(" --skip-pairs") + arm.file("skip.txt")}) {
    const Said said = run_robocd(zero + table + allowed + " 2>&1");
    EXPECT_EQ(said.status, 0) << said.out;
    EXPECT_EQ(Json::parse(said.out)["allowed"], Json::parse(R"([{"link": "base", "body": "table"}])"));
    EXPECT_EQ(run_robocd(path + table + allowed + " 2>&1").status, 0);
  }
  EXPECT_EQ(run_robocd(path + table + " 2>&1").status, 1);
  EXPECT_EQ(run_robocd(zero + table + " --allow base shelf 2>&1").status, 2);
  EXPECT_EQ(run_robocd(zero + table + " --allow legs table 2>&1").status, 2);
  EXPECT_EQ(run_robocd(zero + table + " --skip-pairs" + arm.file("wrong.txt") + " 2>&1").status, 3);
  // Other links still collide with the body.
  EXPECT_EQ(run_robocd(zero + " --env 'table=box:4 4 0.25,xyz=0 0 -0.125' --allow base table 2>/dev/null").status, 1);
}

/// A ball inside a box collides. Inside a closed mesh it collides only with --contained. Holds for check, path and
/// matrix.
TEST(Robocd, TakesPrimitivesForSolids) {
  const test::TemporaryFolder folder;
  folder.write("room.stl", test::cube_stl({0, 0, 0}, 2));
  const auto urdf = [&](const std::string& name, const std::string& outer) {
    folder.write(name, R"(<robot name="in"><link name="outer"><collision><geometry>)" + outer +
                           R"(</geometry></collision></link><link name="between"/>
  <link name="inner"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="turn" type="continuous"><parent link="outer"/><child link="between"/><axis xyz="0 0 1"/></joint>
  <joint name="slide" type="prismatic"><parent link="between"/><child link="inner"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>)");
    return " '" + (folder.path() / name).string() + "'";
  };
  const std::string box = urdf("box.urdf", R"(<box size="4 4 4"/>)");
  const std::string cylinder = urdf("cylinder.urdf", R"(<cylinder radius="2" length="4"/>)");
  const std::string mesh = urdf("mesh.urdf", R"(<mesh filename="room.stl"/>)");
  for (const std::string& robot : {box, cylinder, mesh + " --contained"}) {
    for (const char* mode : {"any", "all", "within:0.1", "closest"})
      EXPECT_EQ(check(robot + " --zero --mode " + mode, 1)["configurations"][0]["collides"], true) << robot << mode;
    EXPECT_EQ(check(robot + " --zero --mode closest", 1)["configurations"][0]["closest"]["distance"], 0.0);
    EXPECT_EQ(check(robot + " --zero --mode within:0.1", 1)["configurations"][0]["pairs"][0]["distance"], 0.0);
    EXPECT_EQ(run_robocd("path" + robot + " --from zero --to 0.5,0.5").status, 1);
    EXPECT_NE(run_robocd("matrix" + robot + " --samples 20 2>/dev/null").out.find("Always"), std::string::npos);
  }
  EXPECT_EQ(check(mesh + " --zero", 0)["configurations"][0]["collides"], false);
  EXPECT_EQ(run_robocd("path" + mesh + " --from zero --to 0.5,0.5").status, 0);
  EXPECT_NE(run_robocd("matrix" + mesh + " --samples 20 2>/dev/null").out.find("Never"), std::string::npos);
}

TEST(Robocd, SamplesWithinTheLimitsAndByIndexAlone) {
  const ArmFolder arm;
  const auto few = arm.path() / "few.csv", many = arm.path() / "many.csv";
  run_robocd("check" + arm.urdf() + " --random 20 --seed 4 --out" + arm.file("few.csv"));
  run_robocd("check" + arm.urdf() + " --random 2000 --seed 4 --threads 2 --out" + arm.file("many.csv"));
  const std::string start = content(few);
  EXPECT_TRUE(content(many).starts_with(start));
  std::istringstream rows(content(many));
  std::string line;
  std::getline(rows, line);
  EXPECT_EQ(line, "shoulder,elbow");
  double low[2] = {9, 9}, high[2] = {-9, -9};
  while (std::getline(rows, line)) {
    const std::size_t comma = line.find(',');
    const double q[2] = {std::stod(line.substr(0, comma)), std::stod(line.substr(comma + 1))};
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], q[k]);
      high[k] = std::max(high[k], q[k]);
    }
  }
  EXPECT_GE(low[0], -3.14159265358979324);
  EXPECT_LE(high[0], 3.14159265358979324);
  EXPECT_GE(low[1], -1.5);
  EXPECT_LE(high[1], 1.0);
  // The extremes of 2 000 samples are within 1 % of the limits; the probability of missing one limit is 2e-9.
  EXPECT_LT(low[0], -3.08);
  EXPECT_GT(high[0], 3.08);
  EXPECT_LT(low[1], -1.475);
  EXPECT_GT(high[1], 0.975);

  const Json sampled = check(arm.urdf() + " --random 20 --seed 4", 1);
  const Json reread = check(arm.urdf() + " --csv-in" + arm.file("few.csv"), 1);
  EXPECT_EQ(sampled["configurations"], reread["configurations"]);
  EXPECT_NE(sampled["configurations"], check(arm.urdf() + " --random 20 --seed 5", 1)["configurations"]);
}

TEST(Robocd, JoinsStates) {
  const ArmFolder arm;
  const std::string srdf = arm.urdf() + " --srdf" + arm.file("arm.srdf");
  run_robocd("check" + srdf + " --state all/turned --state slide/in --out" + arm.file("q.csv"));
  EXPECT_EQ(content(arm.path() / "q.csv"), "shoulder,elbow\n0.5,-1.4\n");
  run_robocd("check" + srdf + " --state slide/in --out" + arm.file("q.csv"));
  EXPECT_EQ(content(arm.path() / "q.csv"), "shoulder,elbow\n0,-1.4\n");
}

TEST(Robocd, WritesAMatrixThatItReads) {
  const ArmFolder arm;
  const std::string command = "matrix" + arm.urdf() + " --samples 500 --seed 2";
  const Said printed = run_robocd(command + " 2>/dev/null");
  ASSERT_EQ(printed.status, 0);
  EXPECT_EQ(run_robocd(command + " --out" + arm.file("out.srdf") + " 2>/dev/null").out, "");
  EXPECT_EQ(content(arm.path() / "out.srdf"), printed.out);
  const Json json = Json::parse(run_robocd("info --json" + arm.urdf() + " --srdf" + arm.file("out.srdf")).out);
  const std::string tested = pairs(json.at("tested_pairs"));
  // With the elbow in, fore collides with base and camera with mast. Upper stays at x = 1 and mast on the axis.
  EXPECT_NE(tested.find("base fore;"), std::string::npos) << tested;
  EXPECT_NE(tested.find("camera mast;"), std::string::npos) << tested;
  EXPECT_EQ(tested.find("upper mast;"), std::string::npos) << tested;
}

TEST(Robocd, AddsAMatrixToTheSrdfThatThereIs) {
  const ArmFolder arm;
  const std::string text = content(arm.path() / "arm.srdf");
  std::string meeting = text;  // disables a pair that collides with the elbow in
  meeting.insert(meeting.find("</robot>"), "  <disable_collisions link1=\"base\" link2=\"fore\" reason=\"mine\"/>\n");
  arm.write("arm.srdf", meeting);
  const std::string command = "matrix" + arm.urdf() + " --samples 500 --seed 2 --srdf" + arm.file("arm.srdf");
  const Said merged = run_robocd(command + " 2>/dev/null");
  ASSERT_EQ(merged.status, 0);
  EXPECT_TRUE(merged.out.starts_with(meeting.substr(0, meeting.find("</robot>")))) << merged.out;
  EXPECT_NE(merged.out.find("<!-- disabled above, but seen in collision: base and fore: in "), std::string::npos);
  const std::string notes = run_robocd(command + " 2>&1 >/dev/null").out;
  EXPECT_NE(notes.find("     2 pairs disabled by "), std::string::npos) << notes;
  EXPECT_NE(notes.find("note: "), std::string::npos) << notes;
  EXPECT_NE(notes.find("disables, but that collide in some configurations: 1;"), std::string::npos) << notes;
  arm.write("merged.srdf", merged.out);
  const Json json = Json::parse(run_robocd("info --json" + arm.urdf() + " --srdf" + arm.file("merged.srdf")).out);
  EXPECT_EQ(pairs(json.at("tested_pairs")), "camera mast;");
  EXPECT_EQ(json.at("states").size(), 2U);
  const Said onto = run_robocd(command + " --out" + arm.file("arm.srdf") + " 2>&1");
  EXPECT_EQ(onto.status, 2);
  EXPECT_EQ(content(arm.path() / "arm.srdf"), meeting);
}

TEST(Robocd, LeavesNothingHalfWritten) {
  const ArmFolder arm;
  EXPECT_EQ(run_robocd("check" + arm.urdf() + " --zero --out /nonexistent/x.csv 2>&1").status, 3);
  EXPECT_EQ(run_robocd("matrix" + arm.urdf() + " --samples 10 --out /nonexistent/x.srdf 2>&1").status, 3);
  EXPECT_EQ(run_robocd("check" + arm.urdf() + " --zero --json >/dev/full 2>/dev/null").status, 3);
}

}  // namespace robocd_test
}  // namespace hinge::robotics
