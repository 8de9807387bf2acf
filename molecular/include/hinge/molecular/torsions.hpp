// SPDX-License-Identifier: BSD-3-Clause
// Torsions: phi, psi, omega, chi1 ... chi4 of amino acids, alpha ... zeta and chi of nucleotides, rotatable bonds of
// all else.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Rotation about the bond atoms[1]-atoms[2]. reference: dihedral angle in the first model, rad, IUPAC sign.
struct Torsion {
  std::uint32_t residue = 0;  ///< omega(i), between i and i + 1, belongs to i, and zeta likewise
  std::string name;           ///< a rotatable bond's is that of its atoms: "C5-C6"
  std::array<std::uint32_t, 4> atoms{};
  double reference = 0.0;
};

/// phi = C(i-1) N CA C, psi = N CA C N(i+1) (the last one N CA C O), omega = CA C N(i+1) CA(i+1), chi by the residue
/// table. Proline has neither phi nor chi.
///
/// Nucleotides (IUPAC-IUB 1983): alpha = O3'(i-1) P O5' C5' (the first one OP3 P O5' C5'), beta = P O5' C5' C4',
/// gamma = O5' C5' C4' C3', epsilon = C4' C3' O3' P(i+1), zeta = C3' O3' P(i+1) O5'(i+1), chi = O4' C1' N9 C4, O4' C1'
/// N1 C2 or O4' C1' C5 C4. Where hydrogens are explicit, those of the ends stand for P in beta and epsilon, and kappa =
/// C1' C2' O2' HO2'. delta lies in the sugar ring, which is rigid, as rings are.
///
/// Rotatable bonds of ligands, sugars and modified residues: single, acyclic, not terminal, no amide. They and bonds
/// between residues that are no polymer's are called by their atoms. Torsions about collinear bonds are undefined: left
/// out, with a note.
std::vector<Torsion> find_torsions(const Structure& structure, std::vector<std::string>& notes);

/// "A:LYS77:chi1", residues as by label().
std::string torsion_label(const Structure& structure, const Torsion& torsion);

/// Dihedral angle of four positions, rad in (-pi, pi], by atan2; NaN when three of them lie on a line up to rounding.
double dihedral(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept;

}  // namespace hinge::molecular
