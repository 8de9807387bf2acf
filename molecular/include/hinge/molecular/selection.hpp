// SPDX-License-Identifier: BSD-3-Clause
// Selections of torsions in words: which of a molecule's degrees of freedom are free.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "hinge/molecular/molecule.hpp"

namespace hinge::molecular {

/// Positions in Molecule::torsions(), sorted. The words, joined by commas (the union counts):
///   all, none
///   backbone   phi and psi (and omega when asked), alpha, beta, gamma, epsilon and zeta
///   chi        side chains and bases: chi, chi1 ..., kappa, and bonds of modified residues beyond those
///   ligands    whatever turns outside of polymers
///   one name for all residues: phi, alpha, chi1 ...; or a bond's two atoms, C5-C6
///   loops      residues outside HELIX and SHEET records
///   every:N    each N-th amino acid or nucleotide of the molecule, starting with the N-th
///   count:K    K of them at regular intervals: number floor((i + 1/2) n / K) of n, i = 0 ... K - 1
///   A:45  A:10-20  A:45:chi1  A:10-20:backbone  B:401:C5-C6    residues of a chain ("_" for a blank name; insertion
///   codes as in 60A)
///   A:all  A:chi  A:phi ...    the same of a whole chain
/// omega is freed only when `omega` is set or it is named. ModelError names the word and what was expected.
std::vector<std::size_t> select_torsions(const Molecule& molecule, std::string_view spec, bool omega);

}  // namespace hinge::molecular
