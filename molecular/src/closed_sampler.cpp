// SPDX-License-Identifier: BSD-3-Clause
// Closed conformations, and the torsions that closed cycles hold.
#include "hinge/molecular/closed_sampler.hpp"

#include <algorithm>

#include "hinge/core/error.hpp"
#include "hinge/kinematics/rigid_cycles.hpp"

namespace hinge::molecular {

ClosedSampler::ClosedSampler(const Molecule& molecule, const DofSelection& selection, const Sampling& sampling,
                             std::uint64_t most_tries)
    : solver_(molecule.model().tree(), selection),
      sampling_(sampling),
      dof_count_(selection.size()),
      most_tries_(most_tries) {
  if (most_tries == 0) throw ModelError("0 tries a sample: expected at least one");
  if (dof_count_ == 0) throw ModelError("no torsion is free: expected some to sample");
}

std::vector<std::size_t> find_held_torsions(const Molecule& molecule, std::span<const std::size_t> torsions) {
  // Coordinates are off by half a thousandth in each of three directions, an axis by two of them over a bond of 1.2 A.
  constexpr double point = 8.7e-4, axis = 2.0 * point / 1.2;
  std::vector<std::size_t> held;
  for (const DofId dof : rigid_cycle_dofs(molecule.model().tree(), molecule.select(torsions), {point, axis}))
    held.push_back(molecule.torsion_of(dof));
  std::sort(held.begin(), held.end());
  return held;
}

}  // namespace hinge::molecular
