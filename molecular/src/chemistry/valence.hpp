// SPDX-License-Identifier: BSD-3-Clause
// Valence: the number and geometry of an atom's bonds, with or without explicit hydrogens.
#pragma once

#include <cstdint>
#include <vector>

#include "hinge/molecular/structure.hpp"
#include "rules/hydrogen_bonds.hpp"

namespace hinge::molecular {

/// From IDATM's types (Meng and Lewis, J. Comput. Chem. 12:891, 1991; ChimeraX's table).
struct Valence {
  int bonds = 0;  ///< largest number of bonds, hydrogens included
  /// 4 tetrahedral, 3 planar, 2 linear, 1 terminal. Counts bonds and lone pairs: above `bonds`, there is a lone pair.
  int shape = 0;
  int present = 0;           ///< bonds in the structure, without coordination
  bool carboxylate = false;  ///< carbon of a carboxylate in Asp or Glu, IDATM's Cac
};

/// Returns one valence per atom. Bonds of metals do not count.
std::vector<Valence> valences(const Structure& structure);

/// As bonded_neighbours without coordination bonds, not sorted.
std::vector<std::vector<std::uint32_t>> covalent_neighbours(const Structure& structure);

/// As hydrogen_bond_roles(structure), with its covalent_neighbours and valences computed before.
std::vector<HydrogenBondRole> hydrogen_bond_roles(const Structure& structure,
                                                  const std::vector<std::vector<std::uint32_t>>& near,
                                                  const std::vector<Valence>& all);

}  // namespace hinge::molecular
