// SPDX-License-Identifier: BSD-3-Clause
// What Probe sees in atoms: radii, who takes part in hydrogen bonds, and charges.
#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "atom_traits.hpp"
#include "hinge/molecular/bond_exclusions.hpp"

namespace hinge::molecular {

namespace {

/// Of the atom, in the residue it belongs to: its own charge or that of the group it is part of.
class Charges {
 public:
  explicit Charges(const Structure& structure) : s_(structure), near_(bonded_neighbours(structure)) {}

  /// A hydrogen has the charge of what bears it.
  int of(std::uint32_t i) const {
    if (s_.atoms[i].element == "H") return near_[i].empty() ? 0 : of_heavy(near_[i].front());
    return of_heavy(i);
  }

 private:
  std::size_t hydrogens(std::uint32_t i) const {
    return static_cast<std::size_t>(
        std::count_if(near_[i].begin(), near_[i].end(), [&](std::uint32_t j) { return s_.atoms[j].element == "H"; }));
  }
  /// Of the ring: does it have both its N-H?
  bool is_histidinium(const Residue& residue) const {
    std::size_t bearing = 0;
    for (std::uint32_t i = residue.first_atom; i < residue.last_atom; ++i)
      if (s_.atoms[i].name == "ND1" || s_.atoms[i].name == "NE2") bearing += hydrogens(i);
    return bearing == 2;
  }
  bool is_terminal_oxygen(std::uint32_t i) const {
    if (near_[i].size() != 1) return false;
    const auto& around = near_[near_[i].front()];
    return std::count_if(around.begin(), around.end(),
                         [&](std::uint32_t j) { return s_.atoms[j].element == "O" && near_[j].size() == 1; }) >= 2;
  }

  int of_heavy(std::uint32_t i) const {
    const Residue& residue = s_.residues[s_.atoms[i].residue];
    const std::string_view of = residue.name, atom = s_.atoms[i].name, element = s_.atoms[i].element;
    if (residue.kind == ResidueKind::amino_acid) {
      if (element == "N" && (of == "LYS" || of == "ARG") && atom != "N") return 1;
      if (of.starts_with('H') && element == "N" && atom != "N") return is_histidinium(residue) ? 1 : 0;
      if (atom == "N") return near_[i].size() == 4 ? 1 : 0;
      // Asp, Glu and the end of the chain.
      return element == "O" && is_terminal_oxygen(i) ? -1 : 0;
    }
    if (residue.kind == ResidueKind::nucleotide) return element == "O" && is_terminal_oxygen(i) ? -1 : 0;
    return 0;
  }

  const Structure& s_;
  std::vector<std::vector<std::uint32_t>> near_;
};

/// Faces of aromatic rings accept hydrogen bonds, those of His do not.
bool is_face(const Structure& s, std::uint32_t i, AtomClass c) {
  const Residue& residue = s.residues[s.atoms[i].residue];
  const std::string_view atom = s.atoms[i].name;
  if (residue.kind == ResidueKind::amino_acid)
    return (c == AtomClass::carbon_aromatic && !residue.name.starts_with('H')) ||
           (residue.name == "TRP" && atom == "NE1");
  // Ring atoms of bases: N1 ... N9 and C2 ... C8, not the groups on them.
  return residue.kind == ResidueKind::nucleotide && atom.size() == 2 && (atom[0] == 'N' || atom[0] == 'C') &&
         atom != "N2" && atom != "N4" && atom != "N6" && atom != "C7";
}

}  // namespace

std::vector<AtomTraits> molprobity_atoms(const Structure& structure) {
  const RadiiSet& probe = radii_set("probe");
  const std::vector<AtomClass> classes = classify_atoms(structure);
  const Charges charges(structure);
  std::vector<AtomTraits> atoms;
  atoms.reserve(classes.size());
  for (std::uint32_t i = 0; i < classes.size(); ++i) {
    const AtomClass c = classes[i];
    const std::string& element = structure.atoms[i].element;
    AtomTraits atom;
    atom.name = type_name(c, element);
    atom.radius = probe.radius(c, element);
    atom.donor = is_polar_hydrogen(c);
    atom.acceptor = is_acceptor(c) || is_face(structure, i, c);
    if (atom.donor || atom.acceptor) atom.charge = charges.of(i);
    atoms.push_back(std::move(atom));
  }
  return atoms;
}

}  // namespace hinge::molecular
