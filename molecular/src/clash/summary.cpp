// SPDX-License-Identifier: BSD-3-Clause
// Counts residues by class and torsions by kind.
#include "hinge/molecular/summary.hpp"

#include "chemistry/nucleotide_table.hpp"
#include "chemistry/residue_table.hpp"

namespace hinge::molecular {

std::string residue_class(const Structure& s, std::uint32_t r) {
  const Residue& residue = s.residues[r];
  if (residue.kind == ResidueKind::amino_acid) return "protein";
  if (residue.kind == ResidueKind::nucleotide) {
    for (std::uint32_t i = residue.first_atom; i < residue.last_atom; ++i)
      if (is_nucleotide_atom(s.atoms[i].name, "O2'")) return "RNA";
    return "DNA";
  }
  if (is_cap(residue.name)) return "cap";
  if (residue.kind == ResidueKind::water) return "water";
  return residue.last_atom - residue.first_atom == 1 ? "ion" : "ligand";
}

std::map<std::string, ClassSummary> residues_by_class(const Structure& s) {
  std::map<std::string, ClassSummary> summary;
  for (std::uint32_t r = 0; r < s.residues.size(); ++r) {
    ClassSummary& of_class = summary[residue_class(s, r)];
    const std::string& chain = s.chains[s.residues[r].chain].name;
    ++of_class.residues;
    ++of_class.chains[chain.empty() ? "_" : chain];
    ++of_class.names[s.residues[r].name];
  }
  return summary;
}

std::map<std::string, std::size_t> torsions_by_kind(const Structure& s, std::span<const Torsion> torsions) {
  std::map<std::string, std::size_t> kinds;
  for (const Torsion& torsion : torsions) {
    const bool bond = torsion.name.find('-') != std::string::npos;
    ++kinds[bond ? "bonds of " + s.residues[torsion.residue].name : torsion.name];
  }
  return kinds;
}

}  // namespace hinge::molecular
