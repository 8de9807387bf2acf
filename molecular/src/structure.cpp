// SPDX-License-Identifier: BSD-3-Clause
// Labels.
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

std::string label(const Structure& structure, std::uint32_t atom) {
  const Residue& residue = structure.residues[structure.atoms[atom].residue];
  const std::string& chain = structure.chains[residue.chain].name;
  std::string text = chain.empty() ? "_" : chain;
  text += ":" + residue.name + std::to_string(residue.sequence_number);
  if (residue.insertion_code != '\0') text += residue.insertion_code;
  return text + ":" + structure.atoms[atom].name;
}

}  // namespace hinge::molecular
