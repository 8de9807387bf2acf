// SPDX-License-Identifier: BSD-3-Clause
// Structure: labels of atoms, and the search for hydrogens.
#include "hinge/molecular/structure.hpp"

#include <algorithm>

namespace hinge::molecular {

std::string label(const Structure& structure, std::uint32_t atom) {
  const Residue& residue = structure.residues[structure.atoms[atom].residue];
  const std::string& chain = structure.chains[residue.chain].name;
  std::string text = chain.empty() ? "_" : chain;
  text += ":" + residue.name + std::to_string(residue.sequence_number);
  if (residue.insertion_code != '\0') text += residue.insertion_code;
  return text + ":" + structure.atoms[atom].name;
}

bool has_hydrogens(const Structure& structure) noexcept {
  return std::any_of(structure.atoms.begin(), structure.atoms.end(),
                     [](const Atom& atom) { return atom.element == "H"; });
}

}  // namespace hinge::molecular
