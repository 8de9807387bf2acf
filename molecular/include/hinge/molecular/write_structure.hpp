// SPDX-License-Identifier: BSD-3-Clause
// Writing conformations: PDB and mmCIF files, and ChimeraX and PyMOL scripts that show the pairs in question.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <span>
#include <string>

#include "hinge/core/vec3.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge::molecular {

/// ModelError, naming the chain, residue or atom that PDB columns cannot hold: a chain name longer than one character,
/// a residue name longer than three, an atom name longer than four, a residue number beyond hybrid-36.
void check_fits_pdb(const Structure& structure);

/// What stands before the models of a PDB file: HELIX, SHEET, SSBOND, LINK (bonds between residues that are no
/// neighbours in their chain), and REMARK 999, which says that the file records every bond that residue names do not
/// tell. read_structure then gives the structure the same bonds, whatever the coordinates. ModelError: check_fits_pdb.
void write_pdb_head(std::ostream& out, const Structure& structure);
/// One MODEL ... ENDMDL block, positions in angstrom, one per atom. Serials beyond 99999 and residue numbers beyond
/// 9999 are hybrid-36. ModelError: check_fits_pdb, or a coordinate that does not fit eight columns.
void write_pdb_model(std::ostream& out, const Structure& structure, std::span<const Vec3> positions, int number);
/// CONECT, a double bond or another multiple one as a repeated partner, and END.
void write_pdb_tail(std::ostream& out, const Structure& structure);

/// The same as mmCIF, which holds names of any length and any number of atoms: struct_conf, struct_sheet_range,
/// struct_conn, chem_comp_bond, and the category hinge_bond, which stands for REMARK 999. At least one model follows.
void write_cif_head(std::ostream& out, const Structure& structure);
/// Coordinates are the shortest decimals that give the same doubles again. first_id: of the model's first atom.
void write_cif_model(std::ostream& out, const Structure& structure, std::span<const Vec3> positions, int number,
                     std::size_t first_id);

/// A script that opens pdb_file (beside it) and marks every pair with a pseudobond and its distance.
void write_chimerax_script(std::ostream& out, const Structure& structure, std::span<const Hit> pairs,
                           const std::string& pdb_file);
void write_pymol_script(std::ostream& out, const Structure& structure, std::span<const Hit> pairs,
                        const std::string& pdb_file);

}  // namespace hinge::molecular
