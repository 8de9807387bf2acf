// SPDX-License-Identifier: BSD-3-Clause
// Tables of nucleotides: heavy-atom bonds by residue name, and old names of atoms.
#pragma once

#include <string_view>

namespace hinge::molecular {

/// Bonds of a base, in the form of ResidueTemplate and in names of PDB format 3.
struct NucleotideTemplate {
  std::string_view name;  ///< name of the base: A, C, G, I, T, U, PSU
  std::string_view base;  ///< bonds of the base; the glycosidic bond first
};

/// Bonds of phosphate and sugar, for DNA and RNA, including the third oxygen of a 5' phosphate.
inline constexpr std::string_view nucleotide_backbone_bonds =
    "P-OP1 P-OP2 P-OP3 P-O5' O5'-C5' C5'-C4' C4'-O4' C4'-C3' C3'-O3' C3'-C2' C2'-O2' C2'-C1' C1'-O4'";

/// Returns the template of a residue name, or null; a static object. Names: A, DA, +A, ADE, RA, chain ends such as A5
/// and DA3, and modified nucleotides, which have more atoms than their template.
const NucleotideTemplate* find_nucleotide_template(std::string_view name) noexcept;

/// True if `name`, from a file, is the atom that is called `today` now (C5', OP1, C7): the same name, or an old one
/// (C5*, O1P, C5M).
bool is_nucleotide_atom(std::string_view name, std::string_view today) noexcept;

}  // namespace hinge::molecular
