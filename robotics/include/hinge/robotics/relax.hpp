// SPDX-License-Identifier: BSD-3-Clause
// relax: moves a robot out of collision, as little as possible.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/robot_checker.hpp"

namespace hinge::robotics {

/// Options of relax().
struct RelaxOptions {
  std::uint64_t most_tries = 20000;  ///< largest number of configurations to test, at least 1
  std::uint64_t seed = 1;            ///< of the random configurations
};

/// The result of relax().
struct Relaxation {
  /// One value per independent joint, rad or m: a free configuration, or the start if none was found.
  std::vector<double> q;
  bool is_free = false;     ///< q collides neither with the robot itself nor with a body
  double distance = 0.0;    ///< root of the sum of squared changes of the joints, rad and m alike
  std::uint64_t tries = 0;  ///< configurations that were tested
  bool stopped = false;     ///< stop() ended the search
};

/// Searches for a free configuration near the start. Meshes have no depth of penetration that could lead out, so the
/// search is random: it draws joints that move the colliding links, in balls around the start that grow until a free
/// configuration is found. Then it goes back to the start as far as it can: joint by joint, along the straight line,
/// and by random steps to places nearer to the start.
///
/// Joints stay within their limits, or where the start is outside, between the limit and the start. The result depends
/// on the arguments alone. It is free by the exact verdict, but not the nearest free configuration for certain. start:
/// one value per independent joint. environment: null if there is none. stop: called at every test; if it returns true,
/// the search ends with what it has. The checker's state changes. Throws ConfigurationError as RobotChecker::update(),
/// ModelError if most_tries is 0 or the environment uses another engine.
HINGE_API Relaxation relax(RobotChecker& checker, Environment* environment, std::span<const double> start,
                           const RelaxOptions& options = {}, const std::function<bool()>& stop = {});

}  // namespace hinge::robotics
