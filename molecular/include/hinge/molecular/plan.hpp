// SPDX-License-Identifier: BSD-3-Clause
// plan: finds a motion between two conformations on which no pair collides.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/fit_coordinates.hpp"

namespace hinge::molecular {

/// An end of a motion.
struct MotionEnd {
  std::vector<double> q;       ///< conformation: one value per selected DOF, rad or angstrom
  TargetCoordinates target{};  ///< coordinates that q was fitted to (fit_coordinates()), or nothing
};

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
  /// that was found.
  std::vector<std::vector<double>> waypoints;
  bool reached = false;       ///< the last waypoint is the end or its replacement
  double length = 0.0;        ///< of the motion, angstrom: sum of the distances between neighbours
  double straight = 0.0;      ///< distance between the conformations of the ends, angstrom
  double remaining = 0.0;     ///< distance from the last waypoint to the end, angstrom; 0 if reached
  double start_rmsd = 0.0;    ///< distance of the first waypoint from the target of the start; 0 without a target
  double end_rmsd = 0.0;      ///< distance of the last waypoint from the target of the end; 0 without a target
  double open = 0.0;          ///< largest residual of a kept closure half way between waypoints, angstrom
  std::uint64_t motions = 0;  ///< motions that were tested
  bool stopped = false;       ///< stop() ended the search
};

/// Plans a motion without collisions from one conformation to another. It tries, in this order:
/// 1. The straight path, and RRT-Connect (Kuffner & LaValle, ICRA 2000; OMPL) with few motions. Half of the random
///    conformations are near the straight path, the others anywhere: torsions within half a turn of the start, placed
///    parts within 10 angstrom of the straight path.
/// 2. Small steps that follow the coordinates of the start on their way to those of the end. Each step minimises the
///    distance from the coordinates, the steric energy (Checker::steric) and the changes of the values together. Such a
///    motion moves all torsions of a protein from one domain arrangement to another.
/// 3. RRT-Connect from where these steps ended.
/// The motion is shortened. Angles have no end: a motion may reach the end with whole turns more or less than it has.
///
/// If q of an end is more than 0.002 angstrom from its target, the motion may have another conformation there. That one
/// is within 1 angstrom of the target, counted over the atoms that the selection moves, or as near as q. Only one end
/// is replaced: `to` if it has such a target, otherwise `from`. This end may collide at q.
///
/// Distances are root mean square displacements of all atoms (of a target: of its atoms) after superposition. With
/// closures, a motion goes in steps of at most 0.05 rad or angstrom per value, and ClosureSolver closes each of them;
/// between two steps the cycles are open by `open`.
///
/// Closures are closed at both ends. The result depends on the arguments alone, if stop never returns true, and it is
/// the same for every engine. stop: called often; if it returns true, the search ends with the nearest conformation so
/// far. The checker is copied. Throws ModelError if nothing is free, most_motions is 0, a closure does not exist, or a
/// target does not fit the molecule; ConfigurationError as Checker::check(), and if an end collides or its closures are
/// open by more than 1e-6 angstrom.
HINGE_API PlannedMotion plan(const Checker& checker, const MotionEnd& from, const MotionEnd& to,
                             const PlanOptions& options = {}, const std::function<bool()>& stop = {});

}  // namespace hinge::molecular
