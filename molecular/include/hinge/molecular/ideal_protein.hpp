// SPDX-License-Identifier: BSD-3-Clause
// build_ideal_protein: a protein of ideal geometry from a sequence, for tests and benchmarks of any length.
#pragma once

#include <string_view>

#include "hinge/core/api.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Returns one chain "A" of heavy atoms, with bonds, helices and strands. Bond lengths and angles after Engh & Huber
/// (Acta Cryst. A47:392, 1991); phi/psi by letter: H -57/-47, E -120/130, C -75/145 degrees (proline phi -65); omega
/// 180; common rotamers. sequence: one-letter codes. secondary_structure: H, E or C, one per residue. Throws ModelError
/// for an unknown letter (with its position), unequal lengths, or an empty sequence. Linear in the length.
HINGE_API Structure build_ideal_protein(std::string_view sequence, std::string_view secondary_structure);

}  // namespace hinge::molecular
