// SPDX-License-Identifier: BSD-3-Clause
// Finds rotatable bonds by rule: bonds of ligands and sugars, and bonds of modified residues that have no named
// torsion.
#pragma once

#include <cstdint>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// A C-O bond of unknown order is single from this length on (angstrom). Alcohols and ethers have 1.43, phenols 1.36,
/// esters 1.34; carboxylates have 1.26, C=O 1.22 (Allen et al., J. Chem. Soc. Perkin Trans. 2 1987, S1).
inline constexpr double single_carbon_oxygen = 1.32;

/// Returns the length (angstrom) from which a bond of unknown order between these elements is single: the midpoint
/// between the shortest single bonds and the longest bonds that do not rotate. These are C-C 1.46 (dienes) and 1.40
/// (aromatic), C-N 1.45 and 1.37 (amides, amidines, most anilines), N-N 1.40 and 1.25 (Allen et al., J. Chem. Soc.
/// Perkin Trans. 2 1987, S1). For C-O see single_carbon_oxygen; other pairs return 0, so all their bonds are single.
double single_bond_from(std::string_view a, std::string_view b) noexcept;

/// Pairs of atom indices, first < second.
using AtomPairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// Returns the rotatable bonds of the first model that are not in `named`. A rotatable bond is single, is in no ring of
/// its residue, has a further heavy atom at both ends, and is no amide, amidine, polymer or coordination bond. The rule
/// applies to residues outside polymers, to polymer residues with heavy atoms beyond our tables or with a covalent bond
/// to another molecule, and to the bonds between them. If the bond order is unknown, the length decides
/// (single_bond_from).
std::vector<Bond> rotatable_bonds(const Structure& structure, const AtomPairs& named);

}  // namespace hinge::molecular
