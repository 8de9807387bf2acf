// SPDX-License-Identifier: BSD-3-Clause
// Tests the ten shared robots against their README and reference_self.txt, on which two other engines agree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "hinge/hierarchy.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/primitive/triangle.hpp"
#include "robotics/robots.hpp"

namespace hinge::robotics {
namespace reference_test {

using NamedPairs = std::set<std::pair<std::string, std::string>>;

std::pair<std::string, std::string> ordered(std::string a, std::string b) {
  return a < b ? std::pair(std::move(a), std::move(b)) : std::pair(std::move(b), std::move(a));
}

struct ReferenceEntry {
  std::vector<double> values;  // in the order of the header's joints
  NamedPairs colliding;
  double distance = 0.0;  // m; 0 when colliding
};

struct Reference {
  std::vector<std::string> joints;
  std::vector<ReferenceEntry> entries;
};

Reference read_reference(const std::filesystem::path& path) {
  Reference reference;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const std::string header = "# joints: ";
    if (line.starts_with(header)) {
      std::istringstream words(line.substr(header.size()));
      for (std::string name; words >> name;) reference.joints.push_back(name);
    }
    if (line.empty() || line[0] == '#') continue;
    std::string part;
    std::istringstream parts(line);
    ReferenceEntry entry;
    std::getline(parts, part, '|');
    std::istringstream numbers(part);
    for (double value = 0; numbers >> value;) entry.values.push_back(value);
    std::getline(parts, part, '|');
    part.erase(std::remove(part.begin(), part.end(), ' '), part.end());
    std::istringstream pairs(part);
    for (std::string pair; part != "-" && std::getline(pairs, pair, ';');)
      entry.colliding.insert(ordered(pair.substr(0, pair.find(',')), pair.substr(pair.find(',') + 1)));
    parts >> entry.distance;
    reference.entries.push_back(entry);
  }
  return reference;
}

std::string text(const NamedPairs& pairs) {
  std::string line;
  for (const auto& [a, b] : pairs) line += a + "," + b + ";";
  return line;
}

class SharedRobots : public testing::TestWithParam<test::SharedRobot> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(test::shared_folder(GetParam().name)))
      GTEST_SKIP() << "no shared data at " << test::shared_folder(GetParam().name);
  }
};

TEST_P(SharedRobots, LoadWithTheNumbersTheirReadmeStates) {
  const test::SharedRobot& expected = GetParam();
  const auto [robot, disabled] = test::load_shared(expected.name);
  const KinematicTree& tree = robot.model().tree();
  const RigidGroups groups(tree, DofSelection::all(tree));
  std::set<std::size_t> groups_with_geometry;
  std::size_t links_with_geometry = 0;
  for (std::size_t l = 1; l < robot.link_count(); ++l) {
    if (robot.triangle_count(id<LinkId>(l)) == 0) continue;
    ++links_with_geometry;
    groups_with_geometry.insert(index(groups.group_of(id<LinkId>(l))));
  }
  EXPECT_EQ(robot.link_count() - 1, expected.links);
  EXPECT_EQ(links_with_geometry, expected.links_with_geometry);
  EXPECT_EQ(groups_with_geometry.size(), expected.groups_with_geometry);
  EXPECT_EQ(robot.independent_joints().size(), expected.dofs);
  EXPECT_EQ(robot.model().size(), expected.triangles);
  EXPECT_EQ(tested_pairs(robot, disabled).size(), expected.pairs);
}

/// A shared robot in a hierarchy, with its reference.
class ReferenceRun {
 public:
  explicit ReferenceRun(const std::string& name)
      : loaded_(test::load_shared(name)),
        hierarchy_(loaded_.robot.model(), LinkPairFilter(loaded_.robot, tested_pairs(loaded_.robot, loaded_.disabled)),
                   UniformClearance(0.0)) {
    const Reference reference = read_reference(test::shared_folder(name) / "reference_self.txt");
    entries_ = reference.entries;
    for (std::size_t k = 0; k < loaded_.robot.independent_joints().size(); ++k) {
      const auto found = std::find(reference.joints.begin(), reference.joints.end(), loaded_.robot.independent_name(k));
      if (found == reference.joints.end()) throw LoadError("no joint " + loaded_.robot.independent_name(k));
      column_.push_back(static_cast<std::size_t>(found - reference.joints.begin()));
    }
  }

  const std::vector<ReferenceEntry>& entries() const { return entries_; }

  NamedPairs colliding(const ReferenceEntry& entry) {
    update(entry);
    NamedPairs pairs;
    for (const Hit& hit : hierarchy_.self_collisions())
      pairs.insert(ordered(name_of_link(hit.first), name_of_link(hit.second)));
    return pairs;
  }

  std::optional<Hit> closest(const ReferenceEntry& entry) {
    update(entry);
    return hierarchy_.self_closest();
  }

 private:
  void update(const ReferenceEntry& entry) {
    std::vector<double> q;
    for (const std::size_t k : column_) q.push_back(entry.values.at(k));
    hierarchy_.update(loaded_.robot.expand(q));
  }
  const std::string& name_of_link(PrimitiveId triangle) const {
    return loaded_.robot.link_name(loaded_.robot.model().links()[index(triangle)]);
  }

  test::LoadedRobot loaded_;
  Hierarchy<Triangle, LinkPairFilter, UniformClearance> hierarchy_;
  std::vector<ReferenceEntry> entries_;
  std::vector<std::size_t> column_;  // column of each independent joint in the reference
};

TEST_P(SharedRobots, CollideWhereTheReferenceSays) {
  ReferenceRun run(GetParam().name);
  ASSERT_GE(run.entries().size(), 100U);
  for (std::size_t c = 0; c < run.entries().size(); ++c)
    EXPECT_EQ(text(run.colliding(run.entries()[c])), text(run.entries()[c].colliding)) << "configuration " << c;
}

TEST_P(SharedRobots, AreAsFarFromThemselvesAsTheReferenceSays) {
  ReferenceRun run(GetParam().name);
  for (std::size_t c = 0; c < run.entries().size(); ++c) {
    const double expected = run.entries()[c].distance;
    const auto closest = run.closest(run.entries()[c]);
    ASSERT_TRUE(closest.has_value());
    // The reference has twelve digits.
    EXPECT_NEAR(closest->distance, expected, 1e-9 * expected) << "entry " << c;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SharedRobots, testing::ValuesIn(test::shared_robots()),
                         [](const auto& robot) { return robot.param.name; });

}  // namespace reference_test
}  // namespace hinge::robotics
