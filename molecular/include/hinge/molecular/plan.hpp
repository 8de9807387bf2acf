// SPDX-License-Identifier: BSD-3-Clause
// plan: finds a motion between two conformations on which no pair collides.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/molecular/checker.hpp"

namespace hinge::molecular {

/// Options of plan().
struct PlanOptions {
  std::vector<std::size_t> closures{};   ///< closures to keep (find_kept_closures), indices in the tree's
  std::uint64_t most_motions = 100'000;  ///< largest number of motions to test before one is found, at least 1
  std::uint64_t seed = 1;                ///< of the random conformations
};

/// The result of plan().
struct PlannedMotion {
  /// Configurations from the start on, one value per selected DOF, rad or angstrom. The straight path from each to the
  /// next is proved free (PathChecker::certify). The last one is the end if it was reached, otherwise the nearest to it
  /// that was reached.
  std::vector<std::vector<double>> waypoints;
  bool reached = false;       ///< the last waypoint is the end
  double length = 0.0;        ///< of the motion, angstrom: sum of the distances between neighbours
  double straight = 0.0;      ///< distance from the start to the end, angstrom
  double remaining = 0.0;     ///< distance from the last waypoint to the end, angstrom; 0 if reached
  double open = 0.0;          ///< largest residual of a kept closure half way between waypoints, angstrom
  std::uint64_t motions = 0;  ///< motions that were tested
  bool stopped = false;       ///< stop() ended the search
};

/// Plans from `from` to `to` with RRT-Connect (Kuffner & LaValle, ICRA 2000; OMPL) and shortens the motion. Half of the
/// random conformations are near the straight path, the others anywhere: torsions within half a turn of the start,
/// placed parts within 10 angstrom of the straight path. Angles have no end: a motion may reach the end with whole
/// turns more or less than `to` has.
///
/// The distance of two conformations is the root mean square displacement of all atoms, linear in the values: every
/// DOF counts with the moment of inertia of the atoms that it moves in the reference, and angles take the shorter way.
/// With closures, a motion goes in steps of at most 0.05 rad or angstrom per value, and ClosureSolver closes each of
/// them; between two steps the cycles are open by `open`.
///
/// from, to: one value per selected DOF, with closures closed. The result depends on the arguments alone, if stop never
/// returns true, and it is the same for every engine. stop: called often; if it returns true, the search ends with the
/// nearest conformation so far. The checker is copied. Throws ModelError if nothing is free, most_motions is 0 or a
/// closure does not exist; ConfigurationError as Checker::check(), and if an end collides or its closures are open by
/// more than 1e-6 angstrom.
HINGE_API PlannedMotion plan(const Checker& checker, std::span<const double> from, std::span<const double> to,
                             const PlanOptions& options = {}, const std::function<bool()>& stop = {});

}  // namespace hinge::molecular
