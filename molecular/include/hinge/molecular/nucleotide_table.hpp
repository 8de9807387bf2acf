// SPDX-License-Identifier: BSD-3-Clause
// What is known of nucleotides by name: heavy-atom bonds, and their atoms' old names.
#pragma once

#include <string_view>

namespace hinge::molecular {

/// Bonds as in ResidueTemplate, in names of PDB format 3.
struct NucleotideTemplate {
  std::string_view name;  ///< of the base: A, C, G, I, T, U, PSU
  std::string_view base;  ///< the base's bonds, the glycosidic one first
};

/// Bonds of phosphate and sugar, of DNA and RNA, the third oxygen of a 5' phosphate included.
inline constexpr std::string_view nucleotide_backbone_bonds =
    "P-OP1 P-OP2 P-OP3 P-O5' O5'-C5' C5'-C4' C4'-O4' C4'-C3' C3'-O3' C3'-C2' C2'-O2' C2'-C1' C1'-O4'";

/// The template of a residue name: A, DA, +A, ADE, RA, chain ends as in A5 and DA3, and modified nucleotides, which
/// have atoms beyond their template; null when there is none.
const NucleotideTemplate* find_nucleotide_template(std::string_view name) noexcept;

/// Is `name`, as a file has it, an atom's name of today (C5', OP1, C7) or one from before (C5*, O1P, C5M)?
bool is_nucleotide_atom(std::string_view name, std::string_view today) noexcept;

}  // namespace hinge::molecular
