// SPDX-License-Identifier: BSD-3-Clause
// Loops: stretches of a chain that move while everything outside them stays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

class Molecule;

/// Residues [first, last], positions in Structure::residues. What may turn is phi and psi of each of them (and omega
/// between two of them); N and CA of the first, CA, C and O of the last and all before and after stand still.
struct Loop {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

/// From "A:40-52"; several joined by commas: a loop is what one word, or one expression of residues (find_part) between
/// commas, selects. ModelError: another form; residues that do not follow one another, residues that are no amino
/// acids, lack N, CA or C, or are not joined by peptide bonds to each other, to the one before and to the one after (a
/// chain's end or a break: free it as it is, it needs no closing); loops that share residues.
std::vector<Loop> find_loops(const Structure& structure, std::string_view words);

/// "A:ASP39-GLY47".
std::string label(const Structure& structure, const Loop& loop);

/// The torsions to free, positions in Molecule::torsions(), sorted: those of the molecule's loops (MoleculeOptions) and
/// what `side_chains` selects (select_torsions). ModelError: side_chains with torsions of a backbone; a loop with fewer
/// than the six turns, the one that follows included, that a closed cycle needs to have another conformation.
std::vector<std::size_t> select_loop_torsions(const Molecule& molecule, std::string_view side_chains, bool omega);

}  // namespace hinge::molecular
