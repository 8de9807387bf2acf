// SPDX-License-Identifier: BSD-3-Clause
// Distances with derivatives of all pairs of links within 0.1 m: RobotChecker::clearances and jacobian() against FCL's
// distance of every pair whose boxes are within 0.1 m. FCL gets its poses for nothing, and neither witness points nor
// derivatives are asked of it. Argument: configurations per robot.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge_tools/clock.hpp"
#include "oracle/fcl_robots.hpp"
#include "robots/make_subject.hpp"

namespace {

using namespace hinge;
using namespace hinge::robotics;

constexpr double influence = 0.1;  // m

using Distances = std::map<std::pair<std::size_t, std::size_t>, double>;

/// Returns the box of every link at every posture, in the world; an empty box for a link without triangles.
std::vector<std::vector<Aabb>> link_boxes(const bench::Subject& subject) {
  const Model<Triangle>& model = subject.robot().model();
  const RigidGroups groups(model.tree(), DofSelection::all(model.tree()));
  std::vector<std::vector<Aabb>> all;
  for (const bench::Posture& posture : subject.postures()) {
    std::vector<Aabb>& boxes = all.emplace_back(model.tree().link_count());
    for (std::size_t i = 0; i < model.size(); ++i) {
      const LinkId link = model.links()[i];
      const Pose pose = posture.groups[index(groups.group_of(link))] * groups.link_in_group(link);
      boxes[index(link)].extend(model.primitives()[i].placed(pose).bounds());
    }
  }
  return all;
}

/// Returns seconds per configuration, the least of five rounds of ask(k).
template <class Ask>
double time_of(std::size_t count, const Ask& ask) {
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 5; ++round) {
    const auto start = tool::Clock::now();
    for (std::size_t k = 0; k < count; ++k) ask(k);
    least = std::min(least, tool::seconds_since(start) / static_cast<double>(count));
  }
  return least;
}

template <oracle::FclBuild build>
double time_fcl(const bench::Subject& subject, const std::vector<std::vector<Aabb>>& boxes,
                std::vector<Distances>& found) {
  oracle::FclRobot<build> robot(subject.meshes(), subject.pairs());
  std::vector<std::vector<oracle::Placement>> postures;
  for (const bench::Posture& posture : subject.postures()) postures.push_back(posture.links);
  robot.set_postures(postures);
  found.assign(boxes.size(), {});
  return time_of(boxes.size(), [&](std::size_t k) {
    robot.take(k);
    found[k].clear();
    for (const auto& [a, b] : subject.pairs())
      if (separation(boxes[k][a], boxes[k][b]) < influence)
        if (const double distance = robot.distance(a, b); distance < influence) found[k][{a, b}] = distance;
  });
}

void run(const bench::SubjectKind& kind, std::size_t count) {
  const bench::Subject subject = bench::make_subject(kind, count);
  const auto robot = std::make_shared<const Robot>(subject.robot());
  RobotChecker checker(robot, subject.filter().tested(), LinkMargins(*robot));
  std::vector<std::vector<double>> configurations;
  for (std::size_t k = 0; k < count; ++k) {  // as those of the postures
    SampleStream stream(bench::robot_seed, k);
    configurations.push_back(test::random_configuration(*robot, stream));
  }
  std::vector<std::vector<LinkClearance>> rows(count);
  double sum = 0.0;  // so that the derivatives are computed
  const double ours = time_of(count, [&](std::size_t k) {
    checker.update(configurations[k]);
    rows[k] = checker.clearances(influence);
    const ClearanceJacobian jacobian = checker.jacobian(std::span<const LinkClearance>(rows[k]));
    for (const double value : std::span(jacobian.data(), static_cast<std::size_t>(jacobian.size()))) sum += value;
  });
  const std::vector<std::vector<Aabb>> boxes = link_boxes(subject);
  std::vector<Distances> debian, native;
  const double fcl = time_fcl<oracle::FclBuild::debian>(subject, boxes, debian),
               here = time_fcl<oracle::FclBuild::native>(subject, boxes, native);
  std::size_t listed = 0, differ = 0;
  double worst = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    listed += rows[k].size();
    Distances others = debian[k];
    for (const LinkClearance& row : rows[k]) {
      const auto other = others.find({index(row.link1), index(row.link2)});
      if (other == others.end()) {
        ++differ;
        continue;
      }
      worst = std::max(worst, std::abs(std::max(row.distance, 0.0) - std::max(other->second, 0.0)));
      others.erase(other);
    }
    differ += others.size();
  }
  std::printf("%-12s %9zu %8.1f %10.1f %12.1f %12.1f %8.1f %8.1f %9zu %10.1e%s\n", subject.name().c_str(),
              robot->model().size(), static_cast<double>(listed) / static_cast<double>(count), 1e6 * ours, 1e6 * fcl,
              1e6 * here, fcl / ours, here / ours, differ, worst, std::isfinite(sum) ? "" : " not finite");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const auto count = static_cast<std::size_t>(argc > 1 ? std::atoi(argv[1]) : 100);
  std::printf("flags: %s; seed %llu; %zu configurations per robot; pairs within %.1f m; us per configuration\n",
              HINGE_BENCH_FLAGS, static_cast<unsigned long long>(bench::robot_seed), count, influence);
  std::printf("%-12s %9s %8s %10s %12s %12s %8s %8s %9s %10s\n", "", "triangles", "pairs", "hinge", "fcl debian",
              "fcl native", "debian/", "native/", "pairs !=", "worst, m");
  for (const bench::SubjectKind& kind : bench::subject_kinds) run(kind, count);
  return 0;
}
