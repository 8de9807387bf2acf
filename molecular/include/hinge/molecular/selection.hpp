// SPDX-License-Identifier: BSD-3-Clause
// Selections of torsions in words: which of a molecule's degrees of freedom are free.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/molecular/molecule.hpp"

namespace hinge::molecular {

/// What an expression selects.
struct SelectedTorsions {
  /// One of the alternatives that ',', '+' or `or` join outside of parentheses.
  struct Word {
    std::string text;       ///< as written
    std::size_t count = 0;  ///< of torsions it frees
  };
  std::vector<std::size_t> torsions;  ///< positions in Molecule::torsions(), sorted
  std::vector<Word> words;            ///< in the order they were written
  std::vector<std::string> notes;     ///< what may not be meant: words that select nothing, or more than they seem to
};

/// The words:
///   all, none
///   backbone   phi and psi (and omega when asked), alpha, beta, gamma, epsilon and zeta
///   chi        side chains and bases: chi, chi1 ..., kappa, and bonds of modified residues beyond those
///   phi, alpha, chi1 ...   the torsion of that name in every residue; or a bond's two atoms, C5-C6
///   ligands    whatever turns outside of polymers
///   loops      residues outside HELIX and SHEET records
///   every:N    each N-th amino acid or nucleotide of the molecule, starting with the N-th
///   count:K    K of them at regular intervals: number floor((i + 1/2) n / K) of n, i = 0 ... K - 1
///   A  KNI     a chain ("_" for a blank name); the residues of that name, where no chain is called so
///   A:45  A:10-20  A:60A  A:HEM  file:2    residues by number (and insertion code) or name; all of a file
///   A:45:chi1  A:10-20:backbone  B:401:C5-C6    torsions of these residues
///   A:all  A:chi  A:phi    torsions of a chain
/// From the loosest: ',' '+' and `or` (the union); `and` (what both select); `not` (all else); parentheses. Names of
/// torsions in a list behind CHAIN: or CHAIN:RESIDUES: belong to these residues: A:1-5:phi,psi is A:1-5:phi and
/// A:1-5:psi. omega is freed only when `omega` is set or a word names it. ModelError names the word, where it stands
/// and what was expected: also for an expression other than none that selects nothing, and for residues or torsions of
/// residues that do.
SelectedTorsions read_selection(const Molecule& molecule, std::string_view expression, bool omega);

/// SelectedTorsions::torsions.
std::vector<std::size_t> select_torsions(const Molecule& molecule, std::string_view expression, bool omega);

}  // namespace hinge::molecular
