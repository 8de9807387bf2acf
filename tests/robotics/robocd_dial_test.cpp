// SPDX-License-Identifier: BSD-3-Clause
// Tests robocd dial: its counts equal independent counts, its recommendation holds on other seeds, and its settings
// give the same verdicts; and the options that it recommends.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "hinge/robotics/random_configuration.hpp"
#include "hinge/robotics/read_urdf.hpp"
#include "robotics/run_robocd.hpp"

namespace hinge::robotics {
namespace robocd_dial_test {

using Json = nlohmann::json;
using test::ArmFolder;
using test::run_robocd;

const std::string data = std::string(HINGE_SOURCE_DIR) + "/robotics/data/";
const std::string arm = " " + data + "arm.urdf ";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string read(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Returns the verdicts of `robocd check --mode any`, one digit per configuration.
std::string verdicts(const std::string& arguments) {
  std::istringstream rows(run_robocd("check" + arguments + " --mode any --csv 2>/dev/null").out);
  std::string line, all;
  std::getline(rows, line);
  while (std::getline(rows, line)) all += line[line.find(',') + 1];
  return all;
}

Json row_of(const Json& dial, std::size_t section, const std::string& name) {
  for (const Json& row : dial.at("sections").at(section).at("rows"))
    if (row.at("name") == name) return row;
  ADD_FAILURE() << "no row " << name;
  return {};
}

struct Errors {
  std::size_t colliding = 0, accepts = 0, rejects = 0;
};

Errors compare(const std::string& truth, const std::string& given) {
  EXPECT_EQ(truth.size(), given.size());
  Errors errors;
  for (std::size_t k = 0; k < std::min(truth.size(), given.size()); ++k) {
    errors.colliding += truth[k] == '1' ? 1U : 0U;
    errors.accepts += truth[k] == '1' && given[k] == '0' ? 1U : 0U;
    errors.rejects += truth[k] == '0' && given[k] == '1' ? 1U : 0U;
  }
  return errors;
}

void expect_errors(const Json& row, const Errors& errors, std::size_t count) {
  EXPECT_EQ(row.at("count"), count) << row;
  EXPECT_EQ(row.at("colliding"), errors.colliding) << row;
  EXPECT_EQ(row.at("free"), count - errors.colliding) << row;
  EXPECT_EQ(row.at("false_accepts"), errors.accepts) << row;
  EXPECT_EQ(row.at("false_rejects"), errors.rejects) << row;
}

TEST(RobocdDial, CountsAreThoseOfBruteForce) {
  const Json dial = Json::parse(run_robocd("dial" + arm + "-n 120 --time 5 --seed 5 --json").out);
  const std::string asked = arm + "--random 120 --seed 5 --engine brute ";
  const std::string truth = verdicts(asked);
  expect_errors(row_of(dial, 0, "shapes of the URDF"), compare(truth, truth), 120);
  expect_errors(row_of(dial, 0, "engine lazy"), compare(truth, truth), 120);
  for (const std::string tier : {"hull", "capsule", "spheres"})
    expect_errors(row_of(dial, 0, tier + " for all links"), compare(truth, verdicts(asked + "--tier " + tier)), 120);
  std::size_t mixed = 0;
  for (const Json& row : dial.at("sections")[0].at("rows")) {
    if (row.at("kind") != "mixed shapes") continue;
    ++mixed;
    expect_errors(row, compare(truth, verdicts(asked + row.at("options").get<std::string>())), 120);
  }
  EXPECT_GE(mixed, 1U);
}

/// The verdict for the robot of ArmFolder, from its dimensions. fore: a square of half edge 1/16 about (r, 0), turned
/// about the origin, against the surface of a cube of half edge 1/8. camera: a ball of radius 1/16 against the box
/// mast. All other tested pairs are apart.
bool collides(double shoulder, double elbow) {
  const double r = 1.5 + elbow, c = std::cos(shoulder), s = std::sin(shoulder);
  std::array<std::array<double, 2>, 4> corners{};
  for (std::size_t k = 0; k < 4; ++k) {
    const double x = r + (k % 2 == 0 ? -0.0625 : 0.0625), y = k < 2 ? -0.0625 : 0.0625;
    corners[k] = {c * x - s * y, s * x + c * y};
  }
  // Separating axes: those of both squares.
  const auto apart = [&](double ax, double ay, double half, double centre) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& [x, y] : corners) {
      low = std::min(low, ax * x + ay * y);
      high = std::max(high, ax * x + ay * y);
    }
    return low > centre + half || high < centre - half;
  };
  const double wide = 0.125 * (std::abs(c) + std::abs(s));
  const bool meet = !apart(1, 0, 0.125, 0) && !apart(0, 1, 0.125, 0) && !apart(c, s, wide, 0) && !apart(-s, c, wide, 0);
  const bool inside = std::ranges::all_of(
      corners, [](const auto& corner) { return std::max(std::abs(corner[0]), std::abs(corner[1])) < 0.125; });
  const double mast = 1.25 + elbow / 2.0;
  double squared = 0.0;
  for (const double distance : {std::abs(r * c), std::abs(r * s), std::abs(mast - 0.5)})
    squared += std::pow(std::max(0.0, distance - 0.0625), 2);
  return (meet && !inside) || squared <= 0.0625 * 0.0625;
}

TEST(RobocdDial, CountsAreThoseOfArithmetic) {
  constexpr std::size_t count = 1000;
  const ArmFolder folder;
  const Json dial = Json::parse(run_robocd("dial" + folder.urdf() + " -n 1000 --time 5 --seed 7 --json").out);
  const Robot robot(read_urdf((folder.path() / "arm.urdf").string()));
  std::string truth, tiered = verdicts(folder.urdf() + " --random 1000 --seed 7 --tier capsule");
  for (std::uint64_t k = 0; k < count; ++k) {
    std::array<double, 2> q{};
    random_configuration(robot, 7, k, q);
    truth += collides(q[0], q[1]) ? '1' : '0';
  }
  EXPECT_GT(std::ranges::count(truth, '1'), 30);
  expect_errors(row_of(dial, 0, "shapes of the URDF"), compare(truth, truth), count);
  expect_errors(row_of(dial, 0, "engine brute"), compare(truth, truth), count);
  const Errors errors = compare(truth, tiered);
  EXPECT_EQ(errors.accepts, 0U);
  EXPECT_GT(errors.rejects, 0U);
  expect_errors(row_of(dial, 0, "capsule for all links"), errors, count);

  // Motions: as docs/reference/robocd.md says how they are drawn.
  const Json step = row_of(dial, 1, "samples every 0.2 rad or m");
  EXPECT_EQ(dial.at("sections")[1].at("population"),
            "straight from a free configuration towards a random one, seed 7");  // few collide, so they are not cut
  std::size_t colliding = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    std::array<double, 2> from{}, to{};
    for (std::uint64_t draw = 0; draw < 20; ++draw) {
      random_configuration(robot, 7, 21 * k + draw, from);
      if (!collides(from[0], from[1])) break;
    }
    random_configuration(robot, 7, 21 * k + 20, to);
    const double farthest = std::max(std::abs(to[0] - from[0]), std::abs(to[1] - from[1]));
    const double steps = std::ceil(farthest / 0.2);
    bool hit = false;
    for (double n = 0.0; n <= steps; ++n)
      hit = hit || collides(from[0] + (to[0] - from[0]) * n / steps, from[1] + (to[1] - from[1]) * n / steps);
    colliding += hit ? 1U : 0U;
  }
  EXPECT_EQ(step.at("colliding").get<std::size_t>() - step.at("false_accepts").get<std::size_t>() +
                step.at("false_rejects").get<std::size_t>(),
            colliding);
  EXPECT_EQ(step.at("false_rejects"), 0);
  EXPECT_GT(colliding, 30U);
}

TEST(RobocdDial, ItsRecommendationHoldsOnOtherSeeds) {
  const test::TemporaryFolder folder;
  const std::string settings = (folder.path() / "arm.settings").string();
  for (const std::string limits : {"", "--most-false-rejects 5 "}) {
    const auto said = run_robocd("dial" + arm + "--time 2 --seed 11 --json " + limits + "--apply " + settings);
    ASSERT_EQ(said.status, 0) << said.out;
    const Json advice = Json::parse(said.out).at("recommendation");
    if (advice.at("check").is_null()) {  // other load may hide every gain
      EXPECT_TRUE(has(advice.at("text"), "keep the shapes of the URDF")) << advice;
      continue;
    }
    EXPECT_EQ(advice.at("check").at("holds"), true);
    EXPECT_GT(advice.at("check").at("speed"), 1.0);
    const std::string file = read(settings);
    EXPECT_TRUE(has(file, "# " + advice.at("text").get<std::string>() + "\n")) << file;
    for (const std::string seed : {"101", "102"}) {
      const std::string asked = arm + "--random 4000 --seed " + seed;
      const std::string with_file = verdicts(asked + " --settings " + settings);
      EXPECT_EQ(with_file, verdicts(asked + " " + advice.at("options").get<std::string>()));
      const Errors errors = compare(verdicts(asked), with_file);
      EXPECT_EQ(errors.accepts, 0U);
      EXPECT_LE(static_cast<double>(errors.rejects), limits.empty() ? 0.015 * 4000 : 0.06 * 4000);
    }
  }
}

TEST(RobocdDial, PairsProvedApartNeverMeet) {
  const Json dial = Json::parse(run_robocd("dial" + arm + "-n 20 --time 1 --json").out);
  std::set<std::string> apart;
  for (const Json& requirement : dial.at("requires"))
    if (has(requirement.at("options"), "--proved-apart"))
      for (const Json& pair : requirement.at("items")) apart.insert(pair);
  EXPECT_GE(apart.size(), 5U);
  const Json check = Json::parse(run_robocd("check" + arm + "--random 5000 --seed 3 --json").out);
  std::size_t met = 0;
  for (const Json& row : check.at("configurations"))
    for (const Json& pair : row.at("pairs")) {
      const std::string first = pair.at("link1"), second = pair.at("link2");
      EXPECT_FALSE(apart.contains(first + ", " + second) || apart.contains(second + ", " + first)) << pair;
      ++met;
    }
  EXPECT_GT(met, 100U);
}

TEST(RobocdDial, SaysWhatNoAnswerDependsOn) {
  const ArmFolder folder;
  EXPECT_TRUE(has(run_robocd("dial" + folder.urdf() + " -n 20 --time 1").out, "links with geometry move as"));
  // The first joint of the arm turns everything but the base; without the base it changes no answer.
  folder.write("turning.urdf", R"(<robot name="turning"><link name="world_link"/>
  <link name="a"><collision><geometry><box size="1 1 1"/></geometry></collision></link><link name="b"/>
  <link name="c"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <joint name="turn" type="continuous"><parent link="world_link"/><child link="a"/><axis xyz="0 0 1"/></joint>
  <joint name="out" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="2" effort="1" velocity="1"/></joint>
  <joint name="up" type="prismatic"><parent link="b"/><child link="c"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="2" effort="1" velocity="1"/></joint></robot>)");
  const std::string turning = folder.file("turning.urdf");
  const std::string said = run_robocd("dial" + turning + " -n 20 --time 1").out;
  EXPECT_TRUE(has(said, "1 joint moves no tested pair of links against each other, so no answer depends on it: turn"))
      << said;
  EXPECT_TRUE(has(said, "2 links have no geometry and cost nothing: world_link, b")) << said;
  EXPECT_FALSE(
      has(run_robocd("dial" + turning + " -n 20 --time 1 --env 'box:1 1 1,xyz=3 0 0'").out, "no answer depends"));
}

TEST(RobocdDial, MeasuresWithTheConfigurationsOfAFile) {
  const test::TemporaryFolder folder;
  const std::string file = (folder.path() / "q.csv").string();
  run_robocd("check" + arm + "--random 200 --seed 9 --out " + file);
  const Json dial = Json::parse(run_robocd("dial" + arm + "--csv-in " + file + " --time 2 --json").out);
  const std::string truth = verdicts(arm + "--csv-in " + file).substr(0, 100);
  expect_errors(row_of(dial, 0, "shapes of the URDF"), compare(truth, truth), 100);
  EXPECT_TRUE(has(dial.at("sections")[0].at("population"), "the first half of "));
}

TEST(RobocdDial, BadInputIsRefused) {
  const test::TemporaryFolder folder;
  const auto refusal = [&](const std::string& arguments, int status) {
    const auto said = run_robocd(arguments + " 2>&1 >/dev/null");
    EXPECT_EQ(said.status, status) << said.out;
    return said.out;
  };
  EXPECT_TRUE(has(refusal("dial" + arm + "--tier hull", 2), "--tier: dial measures the tiers itself"));
  EXPECT_TRUE(has(refusal("dial" + arm + "--time 0", 2), "--time '0'"));
  EXPECT_TRUE(has(refusal("dial" + arm + "--most-false-rejects 101", 2), "--most-false-rejects '101'"));
  EXPECT_TRUE(has(refusal("dial" + arm + "--apply " + data + "arm.urdf", 2), "--apply"));
  folder.write("one.csv", "turn,lift,elbow,roll,bend,grip\n0,0,0,0,0,0\n");
  EXPECT_TRUE(has(refusal("dial" + arm + "--csv-in " + (folder.path() / "one.csv").string(), 2),
                  "one.csv: holds one configuration, expected two or more"));
  EXPECT_TRUE(has(refusal("check" + arm + "--zero --tier box", 2), "--tier 'box': tier 'box', expected mesh, hull"));
  EXPECT_TRUE(has(refusal("check" + arm + "--zero --tier hull --tier mesh", 2), "a second tier for all links"));
  EXPECT_TRUE(has(refusal("check" + arm + "--zero --tier nose=mesh", 2), "link 'nose'"));
  EXPECT_TRUE(has(refusal("check" + arm + "--zero --proved-apart base nose", 2), "has no link 'nose'"));
}

TEST(RobocdSettings, AreOptionsInAFile) {
  const test::TemporaryFolder folder;
  const auto file = [&](const std::string& text) {
    folder.write("s.settings", text);
    return " --settings " + (folder.path() / "s.settings").string();
  };
  const std::string asked = "check" + arm + "--random 500";
  const auto plain = run_robocd(asked + " --json --tier capsule --threads 2");
  EXPECT_EQ(run_robocd(asked + " --json" + file("# a comment\n\n--tier 'capsule'\r\n  --threads 2\n")).out, plain.out);
  const auto refusal = [&](const std::string& text, const std::string& more = "") {
    const auto said = run_robocd(asked + file(text) + more + " 2>&1 >/dev/null");
    EXPECT_TRUE(said.status == 2 || said.status == 3) << said.out;
    return said.out;
  };
  EXPECT_TRUE(has(refusal("--tier hull\n--tears 3\n"), "s.settings:2: unknown option '--tears'"));
  EXPECT_TRUE(has(refusal("tier hull\n"), "s.settings:1: 'tier', expected an option such as"));
  EXPECT_TRUE(has(refusal("--tier=hull\n"), "expected a blank between"));
  EXPECT_TRUE(has(refusal("--tier 'hull\n"), "a quote is not closed"));
  EXPECT_TRUE(has(refusal("--settings other\n"), "--settings inside a settings file"));
  EXPECT_TRUE(has(refusal("--threads 2\n", " --threads 1"), "--threads is given on the command line and in"));
  EXPECT_TRUE(has(run_robocd(asked + " --settings /nowhere 2>&1").out, "/nowhere: cannot be read"));
  const auto path = run_robocd("path" + arm + "--from zero --to zero" + file("--threads 2\n") + " 2>&1");
  EXPECT_TRUE(has(path.out, "s.settings:1: 'robocd path' has no option --threads, so it is left out")) << path.out;
}

/// Writes the options of the proofs about a robot to a file, and returns --settings with its name.
std::string settings_of_proofs(const std::string& robot, const test::TemporaryFolder& folder) {
  std::string lines;
  const Json dial = Json::parse(run_robocd("dial" + robot + " -n 10 --time 1 --json").out);
  for (const Json& requirement : dial.at("requires"))
    if (has(requirement.at("options"), "--proved-apart")) lines = requirement.at("options");
  EXPECT_TRUE(lines.starts_with("--made-for ") && has(lines, " --proved-apart ")) << lines;
  for (std::size_t k = lines.find(" --"); k != std::string::npos; k = lines.find(" --", k)) lines[k] = '\n';
  folder.write("proofs.settings", lines + "\n");
  return "--settings " + (folder.path() / "proofs.settings").string();
}

TEST(RobocdSettings, ProofsHoldWithTiers) {  // which enclose the shapes of the proofs
  const ArmFolder folder;
  const std::string with = folder.urdf() + " " + settings_of_proofs(folder.urdf(), folder);
  for (const char* tier : {"", " --tier hull", " --tier capsule", " --tier base=spheres"})
    EXPECT_LE(run_robocd("check" + with + " --random 100" + tier).status, 1) << tier;
  folder.write("cube.stl", test::cube_stl(Vec3::Zero(), 0.25));
  EXPECT_EQ(run_robocd("check" + with + " --random 100 2>&1").status, 3);
}

TEST(RobocdSettings, ProofsHoldForTheirModelAndWithinTheLimitsOnly) {
  const test::TemporaryFolder folder;
  const std::string settings = settings_of_proofs(arm, folder), with = arm + settings;
  EXPECT_LE(run_robocd("check" + with + " --random 100").status, 1);
  const auto refused = [&](const std::string& arguments) {
    const auto said = run_robocd(arguments + " 2>&1");
    EXPECT_EQ(said.status, 3) << said.out;
    return said.out;
  };
  EXPECT_TRUE(
      has(refused("check" + with + " --random 100 --clearance 0.01"), "--made-for: the settings were made for"));
  EXPECT_TRUE(has(refused("check" + with + " --random 100 --contained"), "--made-for"));
  folder.write("q.csv", "turn,shoulder,elbow,roll,wrist,grip\n0,9,0,0,0,0\n");
  folder.write("arm.urdf", read(data + "arm.urdf") + "<!-- changed -->");
  EXPECT_TRUE(
      has(refused("check " + (folder.path() / "arm.urdf").string() + " --random 10 " + settings), "--made-for"));
  const std::string out = refused("path" + with + " --from zero --to 0,9,0,0,0,0");
  EXPECT_TRUE(has(out, "--proved-apart leaves out pairs that are apart within the joint limits only")) << out;
}

}  // namespace robocd_dial_test
}  // namespace hinge::robotics
