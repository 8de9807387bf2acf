// SPDX-License-Identifier: BSD-3-Clause
// Writing conformations: PDB and mmCIF files, and ChimeraX and PyMOL scripts that show pairs of atoms.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <span>
#include <string>

#include "hinge/core/api.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge::molecular {

/// Throws ModelError, with the chain, residue or atom, if PDB columns cannot hold the structure: a chain name longer
/// than one character, a residue name longer than three, an atom name longer than four, or a residue number below
/// -999 or beyond hybrid-36.
HINGE_API void check_fits_pdb(const Structure& structure);

/// Writes the records before the models of a PDB file: HELIX, SHEET, SSBOND, LINK (bonds between residues that are not
/// neighbours in their chain), and REMARK 999. The remark says that the file records every bond that residue names do
/// not imply; read_structure then restores the same bonds, independent of the coordinates. Throws ModelError as
/// check_fits_pdb does.
HINGE_API void write_pdb_head(std::ostream& out, const Structure& structure);
/// Writes one MODEL ... ENDMDL block. positions: angstrom, one per atom. number: model number. Serial numbers above
/// 99999 and residue numbers above 9999 are hybrid-36. B factors have two digits after the point; outside of -99.99 to
/// 999.99 the nearest of these numbers is written. Throws ModelError as check_fits_pdb does, and if a coordinate does
/// not fit eight columns.
HINGE_API void write_pdb_model(std::ostream& out, const Structure& structure, std::span<const Vec3> positions,
                               int number);
/// Writes CONECT records and END. A multiple bond is a repeated partner.
HINGE_API void write_pdb_tail(std::ostream& out, const Structure& structure);

/// Writes the same data as mmCIF, which holds names of any length and any number of atoms: struct_conf,
/// struct_sheet_range, struct_conn, chem_comp_bond, the category hinge_bond in place of REMARK 999, and the header of
/// atom_site. At least one model must follow.
HINGE_API void write_cif_head(std::ostream& out, const Structure& structure);
/// Writes one model. positions: angstrom, one per atom, as the shortest decimals that read back as the same doubles.
/// B factors are written as floats. number: of the model. first_id: atom_site.id of its first atom.
HINGE_API void write_cif_model(std::ostream& out, const Structure& structure, std::span<const Vec3> positions,
                               int number, std::size_t first_id);

/// Files that a viewer script opens, in the script's folder.
struct ViewedFiles {
  std::string structure;   ///< PDB or mmCIF file of one conformation, whose pairs are marked
  std::string ensemble{};  ///< further conformations of the same atoms: .pdb, .cif, .dcd, .xtc or .npy; empty: none
};

/// Writes a script for ChimeraX that opens the files and marks every pair with a dashed line, its distance and spheres.
/// pairs: PrimitiveId i is atom i. ChimeraX cannot open NumPy files: such an ensemble is left out, with a comment.
HINGE_API void write_chimerax_script(std::ostream& out, const Structure& structure, std::span<const Hit> pairs,
                                     const ViewedFiles& files);
/// The same for PyMOL, which opens all of these files.
HINGE_API void write_pymol_script(std::ostream& out, const Structure& structure, std::span<const Hit> pairs,
                                  const ViewedFiles& files);

}  // namespace hinge::molecular
