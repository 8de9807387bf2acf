// SPDX-License-Identifier: BSD-3-Clause
// fit_torsions: the configuration with the torsions of given coordinates, and the distance between two sets of
// coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/molecular/molecule.hpp"

namespace hinge::molecular {

/// Returns the rotation relative to the reference, rad in (-pi, pi], that gives torsions()[k] its dihedral angle in
/// `positions` (angstrom, one per atom). Throws LoadError if these positions leave the torsion undefined.
HINGE_API double turn_of(const Molecule& molecule, std::size_t k, std::span<const Vec3> positions);

/// Returns such a rotation for each selected DOF, in the selection's order; the selection holds torsions only.
/// positions: angstrom, one per atom. Bond lengths, bond angles and other torsions stay as in the reference, so the
/// result is not a superposition (see superpose). Throws LoadError if these positions leave a torsion undefined.
HINGE_API std::vector<double> fit_torsions(const Molecule& molecule, const DofSelection& selection,
                                           std::span<const Vec3> positions);

/// Returns the values of PlacedPart::dofs for each placed part, angstrom and rad in [-pi, pi]. They move a part of
/// `rebuilt`, where all placements are 0, onto its atoms in `positions` by least squares. Before, `positions` are
/// superposed on the atoms outside placed parts; if there are none, both sets share one frame. rebuilt, positions:
/// angstrom, one per atom. known: atoms whose positions are used, one per atom; empty: all. A part without a known atom
/// stays.
HINGE_API std::vector<std::array<double, 6>> fit_placements(const Molecule& molecule, std::span<const Vec3> rebuilt,
                                                            std::span<const Vec3> positions,
                                                            const std::vector<bool>& known = {});

/// Adds whole turns to each value so that it is within pi of the value in `near`. rad; both of the same length.
HINGE_API void take_shorter_way(std::span<const double> near, std::span<double> turns);

/// Distances between corresponding atoms after superposition, angstrom.
struct Superposition {
  double rmsd = 0.0;       ///< root mean square distance, minimal over rigid motions
  double farthest = 0.0;   ///< largest distance
  std::uint32_t atom = 0;  ///< the atom with that distance
};

/// Returns the distances after the best rigid superposition without reflection, with equal weights (Horn, J. Opt. Soc.
/// Am. A 4:629, 1987). moved, onto: angstrom, of the same length, at least one position.
HINGE_API Superposition superpose(std::span<const Vec3> moved, std::span<const Vec3> onto);

}  // namespace hinge::molecular
