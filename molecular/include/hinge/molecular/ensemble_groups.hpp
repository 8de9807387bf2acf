// SPDX-License-Identifier: BSD-3-Clause
// Rigid groups of an ensemble: what keeps its shape from conformation to conformation, and the torsions between.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/molecular/ensemble_spread.hpp"
#include "hinge/molecular/held_placement.hpp"

namespace hinge::molecular {

/// Atoms whose mutual placement does not change. Segments are what torsions that stay put join, largest first; one that
/// other segments follow on is made of several that torsions lie between, as where a chain leaves a domain and returns.
struct EnsembleGroup {
  std::vector<std::vector<std::uint32_t>> segments;  ///< atoms, sorted
  double spread = 0.0;  ///< largest standard deviation of a distance between two points in it, angstrom

  std::size_t size() const noexcept;
  std::vector<std::uint32_t> atoms() const;  ///< of all segments, sorted
};

struct EnsembleGroups {
  std::vector<EnsembleGroup> groups;  ///< every atom is in one; most atoms first
  std::vector<std::size_t> torsions;  ///< that join two segments, positions in Molecule::torsions(), sorted
  std::vector<double> turn_spreads;   ///< of these torsions, rad
};

/// Two points stay together when the standard deviation of their distance over the ensemble is at most `tolerance`
/// (angstrom); a group is a set of bodies all of whose points do. Torsions are taken by their spread, those that turn
/// least first, and join the bodies on either side when all of them together are a group and the torsion moves atoms
/// beside its axis by no more than the tolerance either (1.44 angstrom off it); then segments of four bodies and more
/// that no turning torsion joins, nearest to rigid first. ModelError: fewer than two conformations; a tolerance that is
/// no length above 0.
EnsembleGroups find_ensemble_groups(const EnsembleSpread& spread, double tolerance);

/// The placements that keep groups of several segments together (MoleculeOptions::held): each segment by the largest of
/// its group.
std::vector<HeldPlacement> held_placements(const Molecule& molecule, const EnsembleGroups& groups);

}  // namespace hinge::molecular
