// SPDX-License-Identifier: BSD-3-Clause
// Bonds that turn by rule: those of ligands, sugars, and of what modified residues have beyond named torsions.
#pragma once

#include <cstdint>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// C-O of unknown order is single from here on (angstrom): 1.43 of alcohols and ethers, 1.36 of phenols, 1.34 of
/// esters; carboxylates have 1.26, C=O 1.22 (Allen et al., J. Chem. Soc. Perkin Trans. 2 1987, S1).
inline constexpr double single_carbon_oxygen = 1.32;

/// The length from which a bond of unknown order between these elements is single (angstrom): the middle of the
/// shortest single bonds and the longest that do not turn. C-C 1.46 (dienes) and 1.40 (aromatic), C-N 1.45 and 1.37
/// (amides, amidines, most anilines), N-N 1.40 and 1.25 (Allen et al., J. Chem. Soc. Perkin Trans. 2 1987, S1). 0 for
/// others.
double single_bond_from(std::string_view a, std::string_view b) noexcept;

/// Pairs of atoms, first < second.
using AtomPairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// Bonds that turn, but for those in `named`: single, in no ring of their residue, with two further heavy atoms, one on
/// either side; no amide, amidine or coordination bond. Looked at are residues outside polymers, polymer residues with
/// heavy atoms beyond our tables or covalently bonded to something else, and the bonds that join them. Where the order
/// is unknown, carbon-carbon, carbon-nitrogen and nitrogen-nitrogen bonds are single when they are long enough.
std::vector<Bond> rotatable_bonds(const Structure& structure, const AtomPairs& named);

}  // namespace hinge::molecular
