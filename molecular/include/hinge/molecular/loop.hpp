// SPDX-License-Identifier: BSD-3-Clause
// Loop: a segment of a chain that moves while all atoms outside it stay fixed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

class Molecule;

/// Residues [first, last], indices in Structure::residues. phi and psi of each residue may turn, and omega between two
/// of them. N and CA of the first residue, CA, C and O of the last one, and all residues outside stay fixed.
struct Loop {
  std::uint32_t first = 0;  ///< first residue
  std::uint32_t last = 0;   ///< last residue, included
};

/// Returns the loops that an expression names, as in "A:40-52" or "A:40-52,B:7-15": one for each word, or expression of
/// residues (find_part), between commas. Throws ModelError for another form; for residues that are not consecutive, are
/// not amino acids with N, CA and C, or are not joined by peptide bonds to each other and to the residues before and
/// after (an end of a chain needs no closing); and for loops that share residues.
HINGE_API std::vector<Loop> find_loops(const Structure& structure, std::string_view words);

/// Returns "A:ASP39-GLY47".
HINGE_API std::string label(const Structure& structure, const Loop& loop);

/// Returns the torsions to free, indices in Molecule::torsions(), sorted: those of the molecule's loops
/// (MoleculeOptions::loops; omega only if `omega` is true) and those that `side_chains` selects (select_torsions).
/// Throws ModelError if side_chains selects a torsion other than chi, or a loop has fewer than six rotations, its last
/// psi included: a closed cycle needs six to have another conformation.
HINGE_API std::vector<std::size_t> select_loop_torsions(const Molecule& molecule, std::string_view side_chains,
                                                        bool omega);

}  // namespace hinge::molecular
