// SPDX-License-Identifier: BSD-3-Clause
// The bonds that a file written by Hinge records, so that a structure written and read again has the same ones.
// C++17: clang compiles read_gemmi.cpp as that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// A pair of atoms by their positions among the atom records of a model, from 0; first < second.
struct RecordedBond {
  std::uint32_t first = 0, second = 0;
  BondOrder order = BondOrder::unknown;
  bool bonded = true;  ///< false: a break, where two neighbours of a chain would be joined by their names
};

/// Every bond but those that the names tell: inside residues of our tables, and from one residue of a chain to the
/// next.
struct RecordedBonds {
  std::size_t atoms = 0;  ///< atom records of a model; another number: somebody edited the file
  std::vector<RecordedBond> bonds;
};

/// What a file of this structure has to record. Positions are those in structure.atoms.
RecordedBonds record_bonds(const Structure& structure);

/// Fills structure.bonds by such records instead of perceive_bonds. Atoms are found by Atom::record.
void take_recorded_bonds(Structure& structure, const RecordedBonds& recorded);

/// Is it a bond from a residue of a chain to the next one, as a sequence has them?
bool joins_neighbours(const Structure& structure, const Bond& bond);

/// Of each residue: how many before it have its chain, number, insertion code and name, which readers take for one.
std::vector<std::uint32_t> copies_of_residues(const Structure& structure);

}  // namespace hinge::molecular
