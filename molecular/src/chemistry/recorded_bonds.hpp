// SPDX-License-Identifier: BSD-3-Clause
// RecordedBonds: the bonds in a file written by Hinge, so that reading restores the bonds of the written structure.
// C++17: clang compiles read_gemmi.cpp in that mode.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// A pair of atoms: indices among the atom records of a model, from 0; first < second.
struct RecordedBond {
  std::uint32_t first = 0, second = 0;
  BondOrder order = BondOrder::unknown;
  bool bonded = true;  ///< false: neighbours in a chain are not bonded, although names and order suggest it
};

/// The bonds that names do not imply. Implied are bonds inside residues of the built-in tables, and between consecutive
/// residues of a chain.
struct RecordedBonds {
  std::size_t atoms = 0;  ///< atom records of a model; another number in the file: it was edited
  std::vector<RecordedBond> bonds;
};

/// Returns the bonds that a file of this structure must record, as indices in structure.atoms.
RecordedBonds record_bonds(const Structure& structure);

/// Sets structure.bonds from these records, in place of perceive_bonds. Atoms are found by Atom::record.
void take_recorded_bonds(Structure& structure, const RecordedBonds& recorded);

/// True if both atoms are named SG. A recorded bond between them is a disulphide, whatever record names it.
inline bool joins_sg(const Structure& structure, std::uint32_t i, std::uint32_t j) {
  return structure.atoms[i].name == "SG" && structure.atoms[j].name == "SG";
}

/// True if the bond joins a residue to the next one of its chain, in sequence order.
bool joins_neighbours(const Structure& structure, const Bond& bond);

/// Returns, per residue, the number of earlier residues with its chain, number, insertion code and name; readers would
/// merge them.
std::vector<std::uint32_t> copies_of_residues(const Structure& structure);

}  // namespace hinge::molecular
