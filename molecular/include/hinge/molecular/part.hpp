// SPDX-License-Identifier: BSD-3-Clause
// Part: some residues of a structure, by the words users have for them: a chain, a ligand, a file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

struct Part {
  std::string name;                     ///< as users call it
  std::vector<std::uint32_t> residues;  ///< positions in Structure::residues, sorted, no repetition
};

/// Whether a bare residue name may stand for several residues: for all of them, or for one that has to be the only one.
enum class ResidueNames : std::uint8_t { all, only };

/// The residues that an expression selects (its grammar: select_torsions). The words:
///   A          a chain ("_" for a blank name)
///   KNI        the residues of that name, where no chain is called so
///   A:45  A:10-20  A:60A  A:HEM    residues of a chain, by number (and insertion code) or name
///   file:2     all of the second file (join_structures)
///   all, ligands, loops, every:N, count:K    the residues that these words are about in selections of torsions
/// ModelError names the word, where it stands, what was found and what was expected; nothing selected is one.
Part find_part(const Structure& structure, std::string_view words, ResidueNames names = ResidueNames::all);

/// Every residue that `part` does not hold; ModelError when it holds all.
Part rest_of(const Structure& structure, const Part& part);

/// Per atom: is it in the part?
std::vector<bool> atoms_in(const Structure& structure, const Part& part);

}  // namespace hinge::molecular
