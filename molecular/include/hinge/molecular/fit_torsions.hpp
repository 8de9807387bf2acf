// SPDX-License-Identifier: BSD-3-Clause
// The configuration whose torsions are those of given coordinates, and how far two sets of coordinates are apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/molecular/molecule.hpp"

namespace hinge::molecular {

/// The turn from the reference, rad in (-pi, pi], that gives torsions()[k] the dihedral angle it has in `positions`
/// (angstrom, one per atom). LoadError: these positions leave it undefined.
double turn_of(const Molecule& molecule, std::size_t k, std::span<const Vec3> positions);

/// Turns from the reference (rad, in (-pi, pi]), one per selected DOF, that give its torsions the dihedral angles they
/// have in `positions` (angstrom, one per atom). What else differs, bond lengths, bond angles and torsions that are not
/// selected, stays as in the reference: see superpose. LoadError: a torsion that these positions leave undefined.
std::vector<double> fit_torsions(const Molecule& molecule, const DofSelection& selection,
                                 std::span<const Vec3> positions);

/// The values of PlacedPart::dofs, part by part, that lay the parts of `rebuilt`, where they are in their place, over
/// their atoms in `positions`, once what is not placed lies over its own (both angstrom, one per atom; molecules whose
/// every atom is placed lie in one frame). Angles in [-pi, pi].
std::vector<std::array<double, 6>> fit_placements(const Molecule& molecule, std::span<const Vec3> rebuilt,
                                                  std::span<const Vec3> positions);

/// Each turn by as many whole turns as take it within half a turn of `near`. As many values in both.
void take_shorter_way(std::span<const double> near, std::span<double> turns);

/// Distances of atoms from each other once one set is laid over the other, angstrom.
struct Superposition {
  double rmsd = 0.0;       ///< root of the mean squared distance, the smallest that a rigid motion leaves
  double farthest = 0.0;   ///< largest distance
  std::uint32_t atom = 0;  ///< whose it is
};

/// Rigid, without mirroring, all atoms weighing alike (S. Umeyama, IEEE PAMI 13(4), 1991, eq. 34-42). As many positions
/// in both, at least one.
Superposition superpose(std::span<const Vec3> moved, std::span<const Vec3> onto);

}  // namespace hinge::molecular
