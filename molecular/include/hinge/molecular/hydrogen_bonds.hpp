// SPDX-License-Identifier: BSD-3-Clause
// Hydrogen bonds of the backbone, by the energy of Kabsch and Sander; which atoms may bond at all.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// N-H ... O=C; positions in Structure::atoms.
struct HydrogenBond {
  std::uint32_t nitrogen = 0;
  std::uint32_t oxygen = 0;
  double energy = 0.0;  ///< kcal/mol, below 0
};

/// The bonds N-H(i) ... O=C(j) of model 0 with E < -0.5 kcal/mol, sorted by nitrogen: the strongest of each N-H, of
/// residues that are not neighbours. E = 0.42 e * 0.20 e * 332 kcal A / (mol e^2) * (1/r(ON) + 1/r(CH) - 1/r(OH) -
/// 1/r(CN)), H 1 A from N against the C=O before it, whatever hydrogens the file has (W. Kabsch and C. Sander,
/// "Dictionary of protein secondary structure", Biopolymers 22, 1983). Proline has no N-H, a chain's first residue no
/// C=O before it.
std::vector<HydrogenBond> find_hydrogen_bonds(const Structure& structure);

/// What an atom may be in a hydrogen bond, whether or not the structure has hydrogens. Donor: hydrogen on N, O or S, or
/// N, O or S that bears one or has fewer bonds than it can have. Acceptor: N, O or S with a lone pair.
struct HydrogenBondRole {
  bool donor = false;
  bool acceptor = false;

  friend bool operator<(const HydrogenBondRole& a, const HydrogenBondRole& b) noexcept {
    return std::tie(a.donor, a.acceptor) < std::tie(b.donor, b.acceptor);
  }
};

/// One per atom: from the residue for amino acids and nucleotides (His as N delta-H, unless hydrogens say otherwise),
/// of others from bonds and their orders, where these are known.
std::vector<HydrogenBondRole> hydrogen_bond_roles(const Structure& structure);

}  // namespace hinge::molecular
