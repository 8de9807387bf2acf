// SPDX-License-Identifier: BSD-3-Clause
// From atoms to bonds: residue templates, components, bonds of polymers, disulphides, records, and covalent radii where
// nothing is known.
#pragma once

#include <string>

#include "hinge/molecular/components.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Fills structure.bonds from names, structure.links and the coordinates of the first model, and says in
/// structure.notes what was guessed: chain breaks, ignored records, residues without a template, each bond between
/// residues that only its distance tells of; structure.bond_sources is the whole list. Near-linear in the number of
/// atoms.
///
/// Inside a residue the first of these that applies: our own table, when it knows every heavy atom; the component of
/// that name; CONECT records, when they join all heavy atoms; our own table for the atoms it knows and covalent radii
/// for others. Between residues: bonds of polymers, records, and as `between` says.
void perceive_bonds(Structure& structure, ComponentLibrary components = {}, BondSearch between = BondSearch::geometry);

/// Metals and metalloids that coordinate; every bond of theirs is taken for a coordination bond.
bool is_metal(const std::string& element) noexcept;

/// Single-bond covalent radius, angstrom (Cordero et al., Dalton Trans. 2008, 2832).
double covalent_radius(const std::string& element) noexcept;

}  // namespace hinge::molecular
