// SPDX-License-Identifier: BSD-3-Clause
// Part: some residues of a structure, selected by words: a chain, a ligand, a file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// A named set of residues.
struct Part {
  std::string name;                     ///< the expression that selected it
  std::vector<std::uint32_t> residues;  ///< indices in Structure::residues, sorted, each once
};

/// Meaning of a residue name without a number. all: every residue of that name; only: the single one, and an error if
/// there are several.
enum class ResidueNames : std::uint8_t { all, only };

/// Returns the residues that an expression selects (its grammar: read_selection). The words:
///   A          a chain ("_" for a blank name)
///   KNI        the residues of that name, if no chain has it
///   A:45  A:10-20  A:60A  A:HEM    residues of a chain, by number (and insertion code) or name
///   file:2     all residues of the second file (join_structures)
///   all, ligands, loops, every:N, count:K    the residues that these words mean in selections of torsions
/// Throws ModelError, with the word, its position, what was found and what was expected; also if nothing is selected.
HINGE_API Part find_part(const Structure& structure, std::string_view words, ResidueNames names = ResidueNames::all);

/// Returns every residue outside `part`. Throws ModelError if there is none.
HINGE_API Part rest_of(const Structure& structure, const Part& part);

/// Returns one value per atom: true if the atom is in the part.
HINGE_API std::vector<bool> atoms_in(const Structure& structure, const Part& part);

}  // namespace hinge::molecular
