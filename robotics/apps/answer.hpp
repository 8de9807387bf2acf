// SPDX-License-Identifier: BSD-3-Clause
// The question asked for every configuration, and the answer of a worker.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "options.hpp"

namespace robocd {

/// The answer for one configuration: the robot against itself, and against the bodies of the environment if there are
/// any.
struct Answer {
  bool collides = false;
  hinge::robotics::Verdict self;
  std::vector<hinge::robotics::BodyContact> body_pairs;
  std::vector<hinge::robotics::ClosestBody> body_distances;  // mode within: of the same pairs
  std::optional<hinge::robotics::ClosestBody> closest_body;
  // Only with --contained.
  std::vector<hinge::robotics::LinkContainment> contained;
  std::vector<hinge::robotics::BodyContainment> contained_bodies;
};

/// Configurations that one call of check_batch() tests.
inline constexpr std::size_t block_size = 64;

/// The data of one thread. Copies share constant data.
struct Worker {
  hinge::robotics::RobotChecker checker;
  std::optional<hinge::robotics::Environment> environment;
};

/// Makes the robot's checker and the environment. Appends notes about the environment's meshes to job.notes. Throws
/// ModelError for a bad engine, clearance or body, LoadError for a bad mesh file.
Worker make_worker(const Options& options, Job& job);
/// Returns the checker of paths for this robot among these bodies.
hinge::robotics::PathChecker path_checker(const Worker& worker);

/// Answers for one configuration. q: one value (rad or m) per independent joint. contained: also list links and bodies
/// inside closed meshes.
Answer ask(Worker& worker, std::span<const double> q, const hinge::robotics::Mode& mode, bool contained);

/// Returns notes about bodies: open meshes, in which --contained finds nothing, and links that no joint moves and that
/// collide with a body, so that every configuration collides.
std::vector<std::string> notes_on_bodies(const Options& options, Worker& worker);

}  // namespace robocd
