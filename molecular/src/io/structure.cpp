// SPDX-License-Identifier: BSD-3-Clause
// Structure: labels of atoms and residues, and the search for hydrogens.
#include "hinge/molecular/structure.hpp"

#include <algorithm>

namespace hinge::molecular {

std::string label(const Structure& structure, std::uint32_t atom) {
  return residue_label(structure, structure.atoms[atom].residue) + ":" + structure.atoms[atom].name;
}

std::string residue_label(const Structure& structure, std::uint32_t residue) {
  const Residue& of = structure.residues[residue];
  const std::string& chain = structure.chains[of.chain].name;
  std::string text = chain.empty() ? "_" : chain;
  text += ":" + of.name + std::to_string(of.sequence_number);
  if (of.insertion_code != '\0') text += of.insertion_code;
  return text;
}

bool has_hydrogens(const Structure& structure) noexcept {
  return std::any_of(structure.atoms.begin(), structure.atoms.end(),
                     [](const Atom& atom) { return atom.element == "H"; });
}

}  // namespace hinge::molecular
