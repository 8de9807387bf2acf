// SPDX-License-Identifier: BSD-3-Clause
// Residue tables of the amino acids: heavy-atom bonds and side-chain torsions by residue name.
#pragma once

#include <cstddef>
#include <string_view>

namespace hinge::molecular {

/// Bonds and torsions of an amino acid, by atom names: pairs and quadruples separated by blanks, as in "CB-CG CG-CD"
/// and "N-CA-CB-CG CA-CB-CG-CD".
struct ResidueTemplate {
  std::string_view name;        ///< three-letter name
  char letter;                  ///< one-letter code; '\0': none
  std::string_view side_chain;  ///< bonds beyond the backbone, from CA-CB on
  std::string_view chi;         ///< atoms of chi1, chi2, ...
};

/// Backbone bonds of every amino acid, including the terminal oxygens in PDB and CHARMM names.
inline constexpr std::string_view backbone_bonds = "N-CA CA-C C-O C-OXT C-OT1 C-OT2";

/// Terminal oxygens in GROMOS names. Used only if the residue has no atom O: otherwise these names mean other atoms, as
/// in sulphotyrosine.
inline constexpr std::string_view gromos_terminal_bonds = "C-O1 C-O2";

/// Returns the PDB's name of a residue that force fields name by its protonation or place in the chain: HIS for HIE and
/// HISE, ALA for NALA. Neutral states of charged residues keep one name each: ASH, GLH, LYN, ARGN. Other names are
/// returned as they are.
std::string_view pdb_residue_name(std::string_view name) noexcept;

/// True for histidine in any protonation, and for its D and methylated forms.
bool is_histidine(std::string_view name) noexcept;

/// Returns the template of a residue name, or null; a static object. Names of force fields, D residues and modified
/// residues share the template of their parent. A modified residue has more atoms than its template.
const ResidueTemplate* find_residue_template(std::string_view name) noexcept;

/// Returns the template of a one-letter code, or null; a static object.
const ResidueTemplate* find_residue_template(char letter) noexcept;

/// True for ACE, FOR, NME, NH2 and ETA: caps end a chain and belong to it.
bool is_cap(std::string_view name) noexcept;

/// Calls visit(first name, second name) for each pair of a bond list such as ResidueTemplate::side_chain.
template <class Visit>
void for_each_bond(std::string_view bonds, const Visit& visit) {
  while (!bonds.empty()) {
    const std::string_view bond = bonds.substr(0, bonds.find(' '));
    const std::size_t dash = bond.find('-');
    visit(bond.substr(0, dash), bond.substr(dash + 1));
    bonds.remove_prefix(bond.size() < bonds.size() ? bond.size() + 1 : bonds.size());
  }
}

}  // namespace hinge::molecular
