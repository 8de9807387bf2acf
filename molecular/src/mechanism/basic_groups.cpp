// SPDX-License-Identifier: BSD-3-Clause
// Divides atoms into basic groups, which become the leaves (BioCD section III).
#include <array>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <vector>

#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

namespace {

bool in_pseudo_backbone(std::string_view atom) {
  static constexpr std::array<std::string_view, 20> names{"N",   "CA",  "C",   "O",  "CB",  "OXT", "OT1",
                                                          "OT2", "H",   "HN",  "D",  "H1",  "H2",  "H3",
                                                          "HT1", "HT2", "HT3", "HA", "HXT", "DA"};
  for (const std::string_view name : names)
    if (atom == name) return true;
  return atom == "HA2" || atom == "HA3" || atom == "1HA" || atom == "2HA";
}

bool in_nucleotide_backbone(std::string_view atom) { return atom.find_first_of("'*P") != std::string_view::npos; }

}  // namespace

std::vector<std::uint32_t> basic_groups(const Structure& structure) {
  // Two labels per residue: 2r for the backbone, 2r + 1 for the other atoms.
  std::vector<std::uint32_t> merged(2 * structure.residues.size());
  std::iota(merged.begin(), merged.end(), 0U);
  const auto find = [&](std::uint32_t label) {
    while (merged[label] != label) label = merged[label];
    return label;
  };
  const auto label_of = [&](std::uint32_t atom) {
    const std::uint32_t r = structure.atoms[atom].residue;
    const Residue& residue = structure.residues[r];
    const std::string_view name = structure.atoms[atom].name;
    bool backbone = true;
    if (residue.kind == ResidueKind::amino_acid && residue.name != "PRO") backbone = in_pseudo_backbone(name);
    if (residue.kind == ResidueKind::nucleotide) backbone = in_nucleotide_backbone(name);
    return 2 * r + (backbone ? 0U : 1U);
  };
  for (const Bond& bond : structure.bonds)
    if (bond.origin == BondOrigin::disulphide) {
      const std::uint32_t a = find(label_of(bond.first)), b = find(label_of(bond.second));
      merged[a > b ? a : b] = a > b ? b : a;
    }
  std::vector<std::uint32_t> labels;
  labels.reserve(structure.atoms.size());
  for (std::uint32_t i = 0; i < structure.atoms.size(); ++i) labels.push_back(find(label_of(i)));
  return labels;
}

}  // namespace hinge::molecular
