// SPDX-License-Identifier: BSD-3-Clause
// follow: a motion that follows coordinates on their way to others.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "motion/coordinate_descent.hpp"
#include "planning/conformation_problem.hpp"

namespace hinge::molecular {

/// The result of follow().
struct Followed {
  std::vector<std::vector<double>> waypoints;  ///< from the start on; the motion between neighbours is proved free
  std::uint64_t motions = 0;                   ///< motions that were tested
};

/// Moves from `from`, which is free, towards coordinates in small steps. The target of a step is a mean of the start's
/// and the end's coordinates, superposed, weighted by the place on the way. A step goes from the conformation before to
/// one near its target that is free (CoordinateDescent::make_free). If the motion between the two is not free, the
/// next step is shorter and stiffer. The way ends where the steps get too short, or after `most_motions` tests.
/// descent: of the atoms of `to`. to: one position per atom of the descent, angstrom, in any frame. stop: if it returns
/// true, the way ends.
Followed follow(ConformationProblem& problem, CoordinateDescent& descent, std::span<const double> from,
                const std::vector<Vec3>& to, std::uint64_t most_motions, const std::function<bool()>& stop);

}  // namespace hinge::molecular
