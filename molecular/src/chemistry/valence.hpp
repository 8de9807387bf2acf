// SPDX-License-Identifier: BSD-3-Clause
// Valence: how many bonds an atom can have and in what shape, whether or not its hydrogens are there.
#pragma once

#include <cstdint>
#include <vector>

#include "clash/hydrogen_bonds.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// As IDATM's types say it (Meng and Lewis, J. Comput. Chem. 12:891, 1991; table of ChimeraX).
struct Valence {
  int bonds = 0;             ///< at most, hydrogens included
  int shape = 0;             ///< 4 tetrahedral, 3 planar, 2 linear, 1 at an end; more than bonds: has a lone pair there
  int present = 0;           ///< bonds there are, coordination bonds left out
  bool carboxylate = false;  ///< carbon with two terminal oxygens in a residue known to be charged, IDATM's Cac
};

/// One per atom. Bonds of metals do not count.
std::vector<Valence> valences(const Structure& structure);

/// As bonded_neighbours, without coordination bonds.
std::vector<std::vector<std::uint32_t>> covalent_neighbours(const Structure& structure);

/// hydrogen_bond_roles of a structure whose covalent_neighbours and valences are at hand.
std::vector<HydrogenBondRole> hydrogen_bond_roles(const Structure& structure,
                                                  const std::vector<std::vector<std::uint32_t>>& near,
                                                  const std::vector<Valence>& all);

}  // namespace hinge::molecular
