// SPDX-License-Identifier: BSD-3-Clause
// Selections of torsions in words: which degrees of freedom of a molecule are free.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/molecular/molecule.hpp"

namespace hinge::molecular {

/// The result of a selection expression.
struct SelectedTorsions {
  /// One of the alternatives that ',', '+' or `or` join outside parentheses.
  struct Word {
    std::string text;       ///< the text in the expression
    std::size_t count = 0;  ///< number of torsions it frees
  };
  std::vector<std::size_t> torsions;  ///< indices in Molecule::torsions(), sorted
  std::vector<Word> words;            ///< in the order of the expression
  std::vector<std::string> notes;     ///< possible mistakes: words that select nothing, or more than they seem to
};

/// Returns the torsions that an expression selects. The words:
///   all, none
///   backbone   phi and psi (and omega if `omega` is true), alpha, beta, gamma, epsilon and zeta
///   chi        side chains and bases: chi, chi1 ..., kappa, and further bonds of modified residues
///   phi, alpha, chi1 ...   the torsion of that name in every residue; or a bond's two atoms, C5-C6
///   ligands    all torsions outside polymers
///   loops      residues outside HELIX and SHEET records
///   every:N    each N-th amino acid or nucleotide of the molecule, starting with the N-th
///   count:K    K of them at regular intervals: number floor((i + 1/2) n / K) of n, i = 0 ... K - 1
///   A  KNI     a chain ("_" for a blank name); the residues of that name, if no chain has it
///   A:45  A:10-20  A:60A  A:HEM  file:2    residues by number (and insertion code) or name; all of a file
///   A:45:chi1  A:10-20:backbone  B:401:C5-C6    torsions of these residues
///   A:all  A:chi  A:phi    torsions of a chain
/// Operators, from the loosest: ',' '+' and `or` (union); `and` (intersection); `not` (complement); parentheses. Names
/// of torsions in a list after CHAIN: or CHAIN:RESIDUES: belong to these residues: A:1-5:phi,psi means A:1-5:phi and
/// A:1-5:psi. omega is freed only if `omega` is true or a word names it. Throws ModelError, with the word, its position
/// and what was expected; also if an expression other than none selects nothing, or a word for residues or for torsions
/// of residues does.
HINGE_API SelectedTorsions read_selection(const Molecule& molecule, std::string_view expression, bool omega);

/// Returns read_selection(...).torsions.
HINGE_API std::vector<std::size_t> select_torsions(const Molecule& molecule, std::string_view expression, bool omega);

}  // namespace hinge::molecular
