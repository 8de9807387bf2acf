// SPDX-License-Identifier: BSD-3-Clause
// Bond perception: from atoms to bonds, by residue tables, components, polymer order, records, and covalent radii as
// the last resort.
#pragma once

#include <string>

#include "hinge/core/api.hpp"
#include "hinge/molecular/components.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Fills structure.bonds (sorted) and structure.bond_sources from names, structure.bond_records and the coordinates
/// of the first model. Adds a note to structure.notes for each guess: chain breaks, ignored records, residues without a
/// template, components whose file cannot be read, and each bond between residues that is known from its distance
/// alone. Time is near-linear in the number of atoms.
///
/// Inside a residue, the first applicable source is used: the built-in table, if it knows every heavy atom; the
/// component of that name; CONECT records, if they connect all heavy atoms; otherwise the table for the atoms that it
/// knows, and covalent radii for the others. Between residues: polymer bonds, recorded bonds, and those that `between`
/// asks for.
HINGE_API void perceive_bonds(Structure& structure, ComponentLibrary components = {},
                              BondSearch between = BondSearch::geometry);

/// True for metals and metalloids that coordinate; every bond of such an atom is a coordination bond. element: symbol
/// as in Atom::element.
HINGE_API bool is_metal(const std::string& element) noexcept;

/// Single-bond covalent radius in angstrom (Cordero et al., Dalton Trans. 2008, 2832); 1.5 for elements that the table
/// lacks.
HINGE_API double covalent_radius(const std::string& element) noexcept;

}  // namespace hinge::molecular
