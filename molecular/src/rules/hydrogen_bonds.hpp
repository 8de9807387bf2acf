// SPDX-License-Identifier: BSD-3-Clause
// Hydrogen bonds of the backbone, by the energy of Kabsch and Sander, and the atoms that can form hydrogen bonds.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// A hydrogen bond N-H ... O=C of the backbone.
struct HydrogenBond {
  std::uint32_t nitrogen = 0;  ///< index in Structure::atoms
  std::uint32_t oxygen = 0;    ///< index in Structure::atoms
  double energy = 0.0;         ///< kcal/mol, below 0
};

/// Returns the bonds N-H(i) ... O=C(j) of model 0 with E < -0.5 kcal/mol, sorted by nitrogen: the strongest of each
/// N-H, between residues that are not neighbours. E = 0.42 e * 0.20 e * 332 kcal A / (mol e^2) * (1/r(ON) + 1/r(CH) -
/// 1/r(OH) - 1/r(CN)) (W. Kabsch and C. Sander, "Dictionary of protein secondary structure", Biopolymers 22, 1983). H
/// lies 1 A from N, in the direction from O to C of the preceding carbonyl; hydrogens of the file are not used. Proline
/// has no N-H, and a residue without a peptide bond to a preceding carbonyl has none either.
std::vector<HydrogenBond> find_hydrogen_bonds(const Structure& structure);

/// The roles of an atom in hydrogen bonds, with or without hydrogens in the structure. Donor: a hydrogen on N, O or S,
/// or an N, O or S that bears a hydrogen or has fewer bonds than it can have. Acceptor: N, O or S with a lone pair.
struct HydrogenBondRole {
  bool donor = false;
  bool acceptor = false;

  friend bool operator<(const HydrogenBondRole& a, const HydrogenBondRole& b) noexcept {
    return std::tie(a.donor, a.acceptor) < std::tie(b.donor, b.acceptor);
  }
};

/// Returns one role per atom. Amino acids and nucleotides: by residue and atom name (His has its hydrogen on N delta,
/// unless the structure has hydrogens). Other residues: by bonds, and by their orders if these are known.
std::vector<HydrogenBondRole> hydrogen_bond_roles(const Structure& structure);

}  // namespace hinge::molecular
