// SPDX-License-Identifier: BSD-3-Clause
// plan: finds a collision-free motion of a robot between two configurations.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge/robotics/robot_checker.hpp"

namespace hinge::robotics {

/// Options of plan().
struct PlanOptions {
  std::uint64_t most_motions = 100000;  ///< largest number of motions to test before the end is reached, at least 1
  std::uint64_t seed = 1;               ///< of the random configurations
};

/// The result of plan(). Lengths and distances are those of plan(), in m.
struct PlannedMotion {
  /// Configurations from the start on, one value per independent joint each, rad or m. The straight motion from each to
  /// the next is proved free. The last one is the end if it was reached, otherwise the nearest to the end that was
  /// found.
  std::vector<std::vector<double>> waypoints;
  bool reached = false;       ///< the last waypoint is the end
  double length = 0.0;        ///< sum of the distances from each waypoint to the next
  double straight = 0.0;      ///< distance from the start to the end
  double remaining = 0.0;     ///< distance from the last waypoint to the end; 0 if it was reached
  std::uint64_t motions = 0;  ///< motions that were tested, those that shortened the result included
  bool stopped = false;       ///< stop() ended the search
};

/// Searches for a motion from one configuration to another by RRT-Connect (Kuffner & LaValle, ICRA 2000), shortens it,
/// and proves each of its straight parts free with PathChecker::certify(); an undecided part counts as not free. The
/// straight motion is tried first.
///
/// The distance of two configurations is the root of the sum of (lever * change)^2 over the joints, in m. The lever of
/// a joint is how far it moves the farthest point of the robot per rad or m, a mean over random configurations.
///
/// Joints stay within their limits, or where an end is outside, between the limit and this end. No joint goes beyond
/// the ends by more than half a turn if it is continuous, a turn if it is revolute, and ten times the robot's size if
/// it is prismatic. Every joint ends at the given value, also a continuous one that is a turn away.
///
/// The result depends on the arguments alone, unless stop() returns true; the engine of the checker does not matter.
/// paths: the robot and the bodies; one PathChecker serves many calls. from, to: one value per independent joint. stop:
/// called between tests; if it returns true, the search ends, and what it has is proved and returned. Throws
/// ConfigurationError, naming the end and the two links or bodies, if an end collides or is so near to a collision that
/// it is not proved free; ConfigurationError if an end has the wrong length or a value that is not finite; ModelError
/// if most_motions is 0.
HINGE_API PlannedMotion plan(PathChecker& paths, std::span<const double> from, std::span<const double> to,
                             const PlanOptions& options = {}, const std::function<bool()>& stop = {});

/// The same for one call: makes the PathChecker, which takes longer than a short search for robots of many triangles.
/// environment: null if there is none. Throws ModelError, too, if the environment uses another engine.
HINGE_API PlannedMotion plan(const RobotChecker& checker, const Environment* environment, std::span<const double> from,
                             std::span<const double> to, const PlanOptions& options = {},
                             const std::function<bool()>& stop = {});

}  // namespace hinge::robotics
