// SPDX-License-Identifier: BSD-3-Clause
// Target: SRDF files and lists of link pairs for one robot.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/bytes.hpp"
#include "fuzz/require.hpp"
#include "fuzz/scratch_file.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/read_srdf.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/tested_pairs.hpp"

namespace {

namespace robotics = hinge::robotics;

/// A chain a - b - c - d with a branch e. Joints: j1 (revolute), j2 (mimics j1), j3 (prismatic), j4 (fixed).
std::shared_ptr<const robotics::Robot> make_robot() {
  robotics::RobotDescription robot;
  robot.name = "arm";
  for (const char* name : {"a", "b", "c", "d", "e"}) robot.links.push_back({name, {{robotics::SphereShape{0.6}, {}}}});
  const auto add = [&](const char* name, robotics::JointType type, const char* parent, const char* child) {
    robotics::JointDescription joint;
    joint.name = name;
    joint.type = type;
    joint.parent = parent;
    joint.child = child;
    joint.origin.translation = {0.0, 0.3, 0.5};
    joint.lower = -1.0;
    joint.upper = 1.0;
    robot.joints.push_back(joint);
  };
  add("j1", robotics::JointType::revolute, "a", "b");
  add("j2", robotics::JointType::revolute, "b", "c");
  add("j3", robotics::JointType::prismatic, "c", "d");
  add("j4", robotics::JointType::fixed, "b", "e");
  robot.joints[1].mimic = robotics::Mimic{"j1", 0.5, 0.1};
  return std::make_shared<const robotics::Robot>(std::move(robot));
}

void check(const std::shared_ptr<const robotics::Robot>& robot, const robotics::Srdf& srdf) {
  fuzz::require(srdf.disabled.link_count() == robot->link_count(), "pairs of another number of links");
  for (const robotics::JointGroup& group : srdf.groups) {
    fuzz::require(std::is_sorted(group.joints.begin(), group.joints.end()), "joints of a group not sorted");
    for (const std::size_t k : group.joints)
      fuzz::require(
          k < robot->description().joints.size() && robot->description().joints[k].type != robotics::JointType::fixed,
          "a group with a joint that does not move");
  }
  std::vector<double> q(robot->independent_joints().size(), 0.0);
  for (const robotics::NamedConfiguration& configuration : srdf.configurations) {
    for (const auto& [position, value] : configuration.values)
      fuzz::require(position < q.size() && hinge::is_finite(value), "a configuration of no joint or no number");
    configuration.apply(q);
  }
  robotics::RobotChecker checker(robot, robotics::tested_pairs(*robot, srdf.disabled), robotics::LinkMargins(*robot));
  fuzz::accepts([&] { checker.check(q, {}); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::shared_ptr<const robotics::Robot> robot = make_robot();
  const fuzz::ScratchFile file("robot.srdf", fuzz::Bytes(data, size).text());
  const bool refused = !fuzz::accepts([&] { check(robot, robotics::read_srdf(file.path(), *robot)); });
  const bool noted =
      fuzz::accepts([&] { check(robot, robotics::read_srdf(file.path(), *robot, robotics::UnknownLinks::noted)); });
  fuzz::require(refused || noted, "what is strictly read must be read laxly too");
  fuzz::accepts([&] {
    robotics::LinkPairs pairs(robot->link_count());
    robotics::read_link_pairs(file.path(), *robot, pairs);
    for (const auto& [a, b] : pairs.list()) fuzz::require(a != b && a != hinge::world, "a pair of no two links");
  });
  return 0;
}
