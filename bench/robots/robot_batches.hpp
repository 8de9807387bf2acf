// SPDX-License-Identifier: BSD-3-Clause
// robot_batches: many configurations of a robot in one call, compared with one call for each.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "results.hpp"
#include "robotics/robots.hpp"
#include "robots/robot_timing.hpp"
#include "robots/subject.hpp"

namespace hinge::bench {

inline constexpr std::size_t batch_edges = 100, edge_states = 16;

/// Configurations one after the other: edges of 16 states, at most 0.3 rad or m per joint, or independent ones.
inline std::vector<double> batch_configurations(const robotics::Robot& robot, bool edges) {
  SampleStream stream(robot_seed, edges ? 1 : 0);
  std::vector<double> all;
  for (std::size_t k = 0; k < batch_edges; ++k) {
    std::vector<double> q = test::random_configuration(robot, stream), step;
    for (std::size_t d = 0; d < q.size(); ++d) step.push_back(0.3 * (2 * stream.uniform() - 1) / edge_states);
    for (std::size_t s = 0; s < edge_states; ++s) {
      all.insert(all.end(), q.begin(), q.end());
      if (!edges) q = test::random_configuration(robot, stream);
      for (std::size_t d = 0; edges && d < q.size(); ++d) q[d] += step[d];
    }
  }
  return all;
}

/// Prints `ratio robot-independent ROBOT single R` and `ratio robot-edges ROBOT single R`: the time of calls of
/// update() and collides() over that of one check_batch(), kinematics included, exact meshes. Both take turns eight
/// times on the same checker, and the best pass counts. Returns the number of different verdicts.
inline std::size_t print_robot_batches(Results& results) {
  std::size_t differences = 0;
  for (const char* name : {"panda", "ur5_robotiq", "talos", "pr2"}) {
    if (!std::filesystem::exists(test::shared_folder(name))) continue;
    const test::LoadedRobot loaded = test::load_shared(name);
    const auto robot = std::make_shared<const robotics::Robot>(loaded.robot);
    robotics::RobotChecker checker(robot, robotics::tested_pairs(*robot, loaded.disabled),
                                   robotics::LinkMargins(*robot));
    const std::size_t values = robot->independent_joints().size();
    for (const bool edges : {false, true}) {
      const std::vector<double> all = batch_configurations(*robot, edges);
      const std::size_t count = all.size() / values;
      std::vector<std::uint8_t> one_by_one(count), together;
      double single = std::numeric_limits<double>::infinity(), batch = single;
      for (int pass = 0; pass < 8; ++pass) {
        double start = thread_seconds();
        for (std::size_t k = 0; k < count; ++k) {
          checker.update(std::span(all).subspan(k * values, values));
          one_by_one[k] = checker.collides() ? 1 : 0;
        }
        single = std::min(single, thread_seconds() - start);
        start = thread_seconds();
        together = checker.check_batch(all);
        batch = std::min(batch, thread_seconds() - start);
        differences += one_by_one == together ? 0 : 1;
      }
      const std::string kind = edges ? "robot-edges" : "robot-independent";
      const double us = 1e6 / static_cast<double>(count);
      results.print("ratio " + kind + ' ' + name + " single", single / batch);
      results.add({{"kind", kind},
                   {"robot", name},
                   {"single_us", single * us},
                   {"batch_us", batch * us},
                   {"colliding", std::count(together.begin(), together.end(), std::uint8_t{1})},
                   {"configurations", count}});
    }
  }
  if (differences != 0) std::printf("%zu passes with a WRONG verdict\n", differences);
  return differences;
}

}  // namespace hinge::bench
