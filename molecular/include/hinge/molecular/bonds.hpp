// SPDX-License-Identifier: BSD-3-Clause
// From atoms to bonds: residue templates, peptide bonds, disulphides, records, and covalent radii where nothing is
// known.
#pragma once

#include <string>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Fills structure.bonds from names, structure.links and the coordinates of the first model, and says in
/// structure.notes what was guessed: chain breaks, ignored records, residues without a template. Near-linear in the
/// number of atoms.
void perceive_bonds(Structure& structure);

/// Single-bond covalent radius, angstrom (Cordero et al., Dalton Trans. 2008, 2832).
double covalent_radius(const std::string& element) noexcept;

}  // namespace hinge::molecular
