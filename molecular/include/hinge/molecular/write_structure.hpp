// SPDX-License-Identifier: BSD-3-Clause
// Writing conformations: PDB models, and ChimeraX and PyMOL scripts that show the pairs in question.
#pragma once

#include <iosfwd>
#include <span>
#include <string>

#include "hinge/core/vec3.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge::molecular {

/// One MODEL ... ENDMDL block, positions in angstrom, one per atom. Serials beyond 99999 are hybrid-36. ModelError: a
/// chain name longer than one character, a coordinate that does not fit eight columns.
void write_pdb_model(std::ostream& out, const Structure& structure, std::span<const Vec3> positions, int number);

/// A script that opens pdb_file (beside it) and marks every pair with a pseudobond and its distance.
void write_chimerax_script(std::ostream& out, const Structure& structure, std::span<const Hit> pairs,
                           const std::string& pdb_file);
void write_pymol_script(std::ostream& out, const Structure& structure, std::span<const Hit> pairs,
                        const std::string& pdb_file);

}  // namespace hinge::molecular
