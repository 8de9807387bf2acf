// SPDX-License-Identifier: BSD-3-Clause
// What is known of residues by name: heavy-atom bonds and side-chain torsions of the amino acids.
#pragma once

#include <cstddef>
#include <string_view>

namespace hinge::molecular {

/// Pairs and quadruples of atom names, separated by blanks: "CB-CG CG-CD", "N-CA-CB-CG CA-CB-CG-CD".
struct ResidueTemplate {
  std::string_view name;
  char letter;                  ///< one-letter code
  std::string_view side_chain;  ///< bonds beyond the backbone, from CA-CB on
  std::string_view chi;         ///< chi1, chi2, ...
};

/// Backbone bonds of every amino acid, terminal atoms in PDB and CHARMM names included.
inline constexpr std::string_view backbone_bonds = "N-CA CA-C C-O C-OXT C-OT1 C-OT2";

/// GROMOS' terminal oxygens, which take the place of O: beside it these names are other atoms', as of sulphotyrosine.
inline constexpr std::string_view gromos_terminal_bonds = "C-O1 C-O2";

/// The template of a residue name, protonation variants, D and modified residues included; null when there is none.
/// A modified residue has atoms beyond its template.
const ResidueTemplate* find_residue_template(std::string_view name) noexcept;

/// The template of a one-letter code; null when there is none.
const ResidueTemplate* find_residue_template(char letter) noexcept;

/// ACE, FOR, NME, NH2, ETA: they end a chain and belong to it.
bool is_cap(std::string_view name) noexcept;

/// Calls visit(first name, second name) for each pair of a bond list.
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
