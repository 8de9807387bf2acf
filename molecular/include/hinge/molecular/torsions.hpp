// SPDX-License-Identifier: BSD-3-Clause
// Torsions: phi, psi, omega, chi1 ... chi4 of amino acids, alpha ... zeta and chi of nucleotides, rotatable bonds of
// all other residues.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// A rotation about the bond atoms[1]-atoms[2].
struct Torsion {
  std::uint32_t residue = 0;  ///< index in Structure::residues; omega and zeta between i and i + 1 belong to i
  std::string name;           ///< "phi", "chi1"; a rotatable bond is named by its atoms: "C5-C6"
  std::array<std::uint32_t, 4> atoms{};  ///< indices in Structure::atoms
  double reference = 0.0;                ///< dihedral angle in the first model, rad, IUPAC sign
};

/// Returns the torsions of a structure, in residue order. Torsions about collinear bonds are undefined: they are left
/// out, with a note.
///
/// Amino acids: phi = C(i-1) N CA C, psi = N CA C N(i+1) (the last one N CA C O), omega = CA C N(i+1) CA(i+1), chi by
/// the residue table. Proline has neither phi nor chi.
///
/// Nucleotides (IUPAC-IUB 1983): alpha = O3'(i-1) P O5' C5' (the first one OP3 or OP1 P O5' C5'), beta = P O5' C5' C4',
/// gamma = O5' C5' C4' C3', epsilon = C4' C3' O3' P(i+1), zeta = C3' O3' P(i+1) O5'(i+1), chi = O4' C1' N9 C4, O4' C1'
/// N1 C2 or O4' C1' C5 C4. At chain ends with explicit hydrogens, the end hydrogen replaces P in beta and epsilon;
/// kappa = C1' C2' O2' HO2'. delta lies in the sugar ring, which is rigid, as all rings are.
///
/// Rotatable bonds of ligands, sugars and modified residues: single, acyclic, not terminal, not an amide. These bonds,
/// and cross-links between residues that can turn, are named by their atoms.
HINGE_API std::vector<Torsion> find_torsions(const Structure& structure, std::vector<std::string>& notes);

/// Returns "A:LYS77:chi1"; the residue is named as by label().
HINGE_API std::string torsion_label(const Structure& structure, const Torsion& torsion);

/// Returns the dihedral angle of four positions, rad in (-pi, pi], IUPAC sign. NaN if three consecutive positions are
/// collinear up to rounding.
HINGE_API double dihedral(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept;

}  // namespace hinge::molecular
