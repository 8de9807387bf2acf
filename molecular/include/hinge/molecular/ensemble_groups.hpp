// SPDX-License-Identifier: BSD-3-Clause
// Rigid groups of an ensemble: sets of atoms that keep their shape in all conformations, and the torsions between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/molecular/ensemble_spread.hpp"
#include "hinge/molecular/held_placement.hpp"

namespace hinge::molecular {

/// A set of atoms that keeps its shape in all conformations. A segment is a set of atoms without a turning torsion
/// inside. A group has several segments if turning torsions lie between them, as where a chain leaves a domain and
/// returns. The largest segment is first.
struct HINGE_API EnsembleGroup {
  std::vector<std::vector<std::uint32_t>> segments;  ///< atom indices, each segment sorted
  double spread = 0.0;  ///< largest standard deviation of a distance between two of its points, angstrom

  /// Number of atoms.
  std::size_t size() const noexcept;
  std::vector<std::uint32_t> atoms() const;  ///< atoms of all segments, sorted
};

/// The result of find_ensemble_groups.
struct EnsembleGroups {
  std::vector<EnsembleGroup> groups;  ///< every atom is in one group; largest group first
  std::vector<std::size_t> torsions;  ///< torsions that join two segments, indices in Molecule::torsions(), sorted
  std::vector<double> turn_spreads;   ///< circular standard deviations of these torsions, rad
};

/// Returns the rigid groups of an ensemble. Two points keep their distance if its standard deviation over the ensemble
/// is at most `tolerance` (angstrom); a group is a set of bodies whose points all do. First, torsions are visited by
/// increasing spread: a torsion joins the sets on both sides if their union is a group, and if it moves atoms near its
/// axis (1.44 angstrom away) by at most the tolerance. The results are the segments. Then segments of at least four
/// bodies that no turning torsion joins are united, those with the least spread first. Throws ModelError for fewer than
/// two conformations, or a tolerance that is not a length above 0.
HINGE_API EnsembleGroups find_ensemble_groups(const EnsembleSpread& spread, double tolerance);

/// Returns placements that keep groups of several segments rigid (MoleculeOptions::held): each segment is held with the
/// largest one of its group. groups: of this molecule.
HINGE_API std::vector<HeldPlacement> held_placements(const Molecule& molecule, const EnsembleGroups& groups);

}  // namespace hinge::molecular
