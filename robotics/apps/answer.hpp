// SPDX-License-Identifier: BSD-3-Clause
// The question asked of every configuration, and what a worker answers.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "options.hpp"

namespace robocd {

/// One configuration: the robot against itself, and against the bodies of the environment where there are any.
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

/// Everything a thread needs; copies share what is constant.
struct Worker {
  hinge::robotics::RobotChecker checker;
  std::optional<hinge::robotics::Environment> environment;
};

/// job.notes gets what the meshes of the environment have to say. ModelError: engine or clearance. LoadError: such a
/// mesh.
Worker make_worker(const Options& options, Job& job);

/// q: one value (rad or m) per independent joint. contained: name what is inside closed meshes, too.
Answer ask(Worker& worker, std::span<const double> q, const hinge::robotics::Mode& mode, bool contained);

/// Sentences on bodies: open meshes, in which --contained can find nothing, and links that no joint moves and that
/// touch a body therefore in every configuration.
std::vector<std::string> notes_on_bodies(const Options& options, Worker& worker);

}  // namespace robocd
