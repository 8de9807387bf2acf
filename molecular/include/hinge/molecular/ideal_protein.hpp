// SPDX-License-Identifier: BSD-3-Clause
// Proteins of ideal geometry from a sequence: test and benchmark material of any length that needs no file.
#pragma once

#include <string_view>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// One chain "A", heavy atoms, bonds perceived, helices and strands recorded. Bond lengths and angles after Engh &
/// Huber (Acta Cryst. A47:392, 1991), phi/psi by letter: H -57/-47, E -120/130, C -75/145 degrees (proline phi -65),
/// omega 180, common rotamers. sequence: one-letter codes; secondary_structure: H, E or C, as long as the sequence.
/// ModelError names the position of a letter that is none, unequal lengths, or an empty sequence. Linear in the length.
Structure build_ideal_protein(std::string_view sequence, std::string_view secondary_structure);

}  // namespace hinge::molecular
