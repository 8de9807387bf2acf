// SPDX-License-Identifier: BSD-3-Clause
// Tests robocd on the shared robots against reference_self.txt, on which two other engines agree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "hinge/robotics/robot_checker.hpp"
#include "robotics/robots.hpp"
#include "robotics/run_robocd.hpp"

namespace hinge::robotics {
namespace robocd_reference_test {

using Json = nlohmann::json;
using test::run_robocd;

struct Expected {
  std::set<std::string> pairs;  // "a,b" with a < b
  double distance = 0.0;        // m; 0 when colliding
};

std::string ordered(const std::string& a, const std::string& b) { return std::min(a, b) + "," + std::max(a, b); }

/// Writes the joint values of the reference to a CSV file, and returns its expected answers.
std::vector<Expected> rewrite_reference(const std::filesystem::path& path, std::size_t most, std::string& csv) {
  const auto joined = [](std::string words) {
    std::istringstream in(words);
    std::string line;
    for (std::string word; in >> word;) line += (line.empty() ? "" : ",") + word;
    return line + "\n";
  };
  std::vector<Expected> all;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line) && all.size() < most;) {
    if (line.starts_with("# joints: ")) csv = joined(line.substr(10));
    if (line.empty() || line[0] == '#') continue;
    const std::size_t first = line.find(" | "), second = line.find(" | ", first + 1);
    csv += joined(line.substr(0, first));
    Expected& expected = all.emplace_back();
    expected.distance = std::stod(line.substr(second + 3));
    std::istringstream pairs(line.substr(first + 3, second - first - 3));
    for (std::string pair; std::getline(pairs, pair, ';');)
      if (const std::size_t comma = pair.find(','); comma != std::string::npos)
        expected.pairs.insert(ordered(pair.substr(0, comma), pair.substr(comma + 1)));
  }
  return all;
}

/// Returns the pairs of links of which one is inside the other, without touching its surface.
std::set<std::string> insides(RobotChecker& checker, const std::vector<double>& q) {
  std::set<std::string> pairs;
  checker.update(q);
  for (const LinkContainment& pair : checker.contained())
    pairs.insert(ordered(checker.robot().link_name(pair.outer), checker.robot().link_name(pair.inner)));
  return pairs;
}

bool tries_all() { return std::getenv("HINGE_TEST_ALL") != nullptr; }

class RobocdReplay : public testing::TestWithParam<test::SharedRobot> {};

TEST_P(RobocdReplay, AgreesWithTheReference) {
  const test::SharedRobot& robot = GetParam();
  const std::filesystem::path folder = test::shared_folder(robot.name);
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared data at " << folder;
  if (robot.name != "panda" && !tries_all()) GTEST_SKIP() << "only with HINGE_TEST_ALL";
  const test::TemporaryFolder temporary;
  std::string csv;
  const auto expected = rewrite_reference(folder / "reference_self.txt", tries_all() ? 1000 : 20, csv);
  ASSERT_GE(expected.size(), 20U);
  const auto in_folder = [&](const std::string& name) { return " '" + (folder / name).string() + "'"; };
  std::string command = "check" + in_folder(robot.name + ".urdf") + " --json --primitives reference --threads 2" +
                        " --note-unknown-links --csv-in '" + temporary.write("q.csv", csv).string() + "'";
  for (const auto& [option, suffix] : {std::pair(" --srdf", ".srdf"), std::pair(" --skip-pairs", ".acm_extra.txt")})
    if (std::filesystem::exists(folder / (robot.name + suffix))) command += option + in_folder(robot.name + suffix);

  const Json all = Json::parse(run_robocd(command + " --mode all 2>/dev/null").out);
  const Json closest = Json::parse(run_robocd(command + " --mode closest 2>/dev/null").out);
  EXPECT_EQ(all.at("robot").at("tested_pairs"), robot.pairs);
  ASSERT_EQ(all.at("configurations").size(), expected.size());
  ASSERT_EQ(closest.at("configurations").size(), expected.size());
  const auto [loaded, disabled] = test::load_shared(robot.name);
  const auto shared = std::make_shared<const Robot>(loaded);
  RobotChecker checker(shared, tested_pairs(*shared, disabled), LinkMargins(*shared));
  for (std::size_t k = 0; k < expected.size(); ++k) {
    SCOPED_TRACE("configuration " + std::to_string(k));
    const Json& row = all["configurations"][k];
    std::set<std::string> pairs, more;
    for (const Json& pair : row.at("pairs")) pairs.insert(ordered(pair.at("link1"), pair.at("link2")));
    EXPECT_EQ(row.at("collides"), !pairs.empty());
    // The reference knows surfaces only. For robocd, boxes, cylinders, spheres and capsules are solid.
    std::set_difference(pairs.begin(), pairs.end(), expected[k].pairs.begin(), expected[k].pairs.end(),
                        std::inserter(more, more.end()));
    EXPECT_EQ(pairs.size() - more.size(), expected[k].pairs.size());
    const std::set<std::string> inside = insides(checker, row.at("values"));
    for (const std::string& pair : more) EXPECT_TRUE(inside.contains(pair)) << pair;
    const double distance = closest["configurations"][k].at("closest").at("distance");
    // The reference has twelve digits.
    if (more.empty())
      EXPECT_NEAR(distance, expected[k].distance, 1e-9 * expected[k].distance);
    else
      EXPECT_EQ(distance, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, RobocdReplay, testing::ValuesIn(test::shared_robots()),
                         [](const auto& robot) { return robot.param.name; });

}  // namespace robocd_reference_test
}  // namespace hinge::robotics
