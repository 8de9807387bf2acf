// SPDX-License-Identifier: BSD-3-Clause
// Named torsions of amino acids: phi, psi, omega, chi1 ... chi4.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Rotation about the bond atoms[1]-atoms[2]. reference: dihedral angle in the first model, rad, IUPAC sign.
struct Torsion {
  std::uint32_t residue = 0;  ///< omega(i), between i and i + 1, belongs to i
  std::string name;
  std::array<std::uint32_t, 4> atoms{};
  double reference = 0.0;
};

/// phi = C(i-1) N CA C, psi = N CA C N(i+1) (the last one N CA C O), omega = CA C N(i+1) CA(i+1), chi by the residue
/// table. Proline has neither phi nor chi. Torsions about collinear bonds are undefined: left out, with a note.
std::vector<Torsion> find_torsions(const Structure& structure, std::vector<std::string>& notes);

/// Dihedral angle of four positions, rad in (-pi, pi], by atan2; NaN when three of them lie on a line up to rounding.
double dihedral(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept;

}  // namespace hinge::molecular
