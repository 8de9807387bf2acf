// SPDX-License-Identifier: BSD-3-Clause
// Assigns Probe's atom properties: radii, hydrogen-bond donors and acceptors, and charges.
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "chemistry/atom_traits.hpp"
#include "chemistry/residue_table.hpp"
#include "chemistry/valence.hpp"
#include "hinge/molecular/bond_exclusions.hpp"

namespace hinge::molecular {

namespace {

/// Formal charges of atoms: each atom has the charge of its charged group.
class Charges {
 public:
  explicit Charges(const Structure& structure) : s_(structure), near_(covalent_neighbours(structure)) {}

  /// Returns -1, 0 or 1. A hydrogen has the charge of the atom it is bonded to.
  int of(std::uint32_t i) const {
    if (s_.atoms[i].element == "H") return near_[i].empty() ? 0 : of_heavy(near_[i].front());
    return of_heavy(i);
  }

 private:
  std::size_t hydrogens(std::uint32_t i) const {
    return static_cast<std::size_t>(
        std::count_if(near_[i].begin(), near_[i].end(), [&](std::uint32_t j) { return s_.atoms[j].element == "H"; }));
  }
  /// Returns true if both ring nitrogens bear a hydrogen.
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
    const std::string_view of = pdb_residue_name(residue.name), atom = s_.atoms[i].name, element = s_.atoms[i].element;
    if (residue.kind == ResidueKind::amino_acid) {
      if (element == "N" && (of == "LYS" || of == "ARG") && atom != "N") return 1;
      if (of.starts_with('H') && element == "N" && atom != "N") return is_histidinium(residue) ? 1 : 0;
      if (atom == "N") return near_[i].size() == 4 ? 1 : 0;
      // Carboxylates of Asp, Glu and the C-terminus.
      return element == "O" && is_terminal_oxygen(i) ? -1 : 0;
    }
    if (residue.kind == ResidueKind::nucleotide) return element == "O" && is_terminal_oxygen(i) ? -1 : 0;
    return 0;
  }

  const Structure& s_;
  std::vector<std::vector<std::uint32_t>> near_;
};

bool is_one_of(std::string_view name, std::string_view list) {  // list: ":A:DA:"
  return list.find(':' + std::string(name) + ':') != std::string_view::npos;
}

/// Names of the residues that Probe knows (pdb_residue_name()). In any other residue it sees no aromatic rings and no
/// carbonyls. Neutral states that Probe does not know are listed too, so that they count as their residue.
constexpr std::string_view amino_acids =
    ":GLY:ALA:VAL:PHE:PRO:MET:ILE:LEU:ASP:GLU:LYS:ARG:SER:THR:TYR:HIS:CYS:ASN:GLN:TRP:ASX:GLX:ACE:FOR:NH2:NME:MSE:AIB:"
    "ABU:PCA:ASH:GLH:LYN:ARGN:";
constexpr std::string_view adenines = ":A:ADE:ATP:ADP:AMP:1MA:RIA:T6A:DA:AR:";
constexpr std::string_view guanines = ":G:GUA:GTP:GDP:GMP:GSP:1MG:2MG:M2G:7MG:OMG:DG:GR:YG:";
constexpr std::string_view inosines = ":I:DI:";
constexpr std::string_view uracils = ":U:URA:UTP:UDP:UMP:UR:PSU:";
constexpr std::string_view thymines = ":T:THY:TTP:TDP:TMP:5MU:DT:TR:";
constexpr std::string_view cytosines = ":C:CYT:CTP:CDP:CMP:5MC:OMC:DC:CR:";

bool is_purine(std::string_view residue) {
  return is_one_of(residue, adenines) || is_one_of(residue, guanines) || is_one_of(residue, inosines);
}
bool is_base(std::string_view residue) {
  return is_purine(residue) || is_one_of(residue, uracils) || is_one_of(residue, thymines) ||
         is_one_of(residue, cytosines);
}

/// Returns true for ring atoms of bases and of the pyrroles of haem.
bool is_base_ring(std::string_view residue, std::string_view atom) {
  if (residue == "HEM")
    return is_one_of(atom, ":NA:NB:NC:ND:C1A:C2A:C3A:C4A:C1B:C2B:C3B:C4B:C1C:C2C:C3C:C4C:C1D:C2D:C3D:C4D:");
  if (residue == "YG" && is_one_of(atom, ":N2:C11:C12:")) return true;
  return (is_base(residue) && is_one_of(atom, ":N1:C2:N3:C4:C5:C6:")) ||
         (is_purine(residue) && is_one_of(atom, ":N7:C8:N9:"));
}

/// Returns true for hydrogens on carbons of base rings.
bool is_base_hydrogen(std::string_view residue, std::string_view atom) {
  if (is_one_of(residue, adenines) || is_one_of(residue, inosines)) return atom == "H8" || atom == "H2";
  if (is_one_of(residue, guanines)) return atom == "H8";
  if (is_one_of(residue, cytosines)) return atom == "H5" || atom == "H6";
  if (is_one_of(residue, uracils)) return atom == "H6" || (atom == "H5" && residue != "PSU");
  return is_one_of(residue, thymines) && atom == "H6";
}

/// Returns true for atoms of aromatic rings, whose faces accept hydrogen bonds. Rings of His do not accept them.
bool is_face(const Structure& s, std::uint32_t i, AtomClass c) {
  const std::string_view residue = pdb_residue_name(s.residues[s.atoms[i].residue].name), atom = s.atoms[i].name;
  if (is_one_of(residue, amino_acids))
    return (c == AtomClass::carbon_aromatic && !residue.starts_with('H')) || (residue == "TRP" && atom == "NE1");
  return is_base_ring(residue, atom);
}

/// Returns true for nitrogens that accept in Probe, with any bonds, because its tables do not call them donors: all
/// nitrogens of residues it does not know (except N3 of H2U), and N2 of M2G, which is neither in a ring nor in an amino
/// group.
bool is_unknown_nitrogen(const Structure& s, std::uint32_t i) {
  const std::string_view residue = pdb_residue_name(s.residues[s.atoms[i].residue].name), atom = s.atoms[i].name;
  if (s.atoms[i].element != "N" || is_one_of(residue, amino_acids)) return false;
  if (residue == "H2U") return atom != "N3";
  return !is_base(residue) || (residue == "M2G" && atom == "N2");
}

}  // namespace

std::vector<AtomClass> probe_classes(const Structure& structure) {
  std::vector<AtomClass> classes = classify_atoms(structure);
  for (std::uint32_t i = 0; i < classes.size(); ++i) {
    const std::string_view residue = pdb_residue_name(structure.residues[structure.atoms[i].residue].name);
    if (is_one_of(residue, amino_acids)) continue;
    const std::string_view atom = structure.atoms[i].name, element = structure.atoms[i].element;
    AtomClass& c = classes[i];
    if (element == "C")
      c = is_base_ring(residue, atom) ? AtomClass::carbon_aromatic : AtomClass::carbon;
    else if (element == "H" && !is_polar_hydrogen(c))
      c = is_base_hydrogen(residue, atom) ? AtomClass::hydrogen_aromatic : AtomClass::hydrogen;
  }
  return classes;
}

std::vector<AtomTraits> molprobity_atoms(const Structure& structure) {
  const RadiiSet& probe = radii_set("probe");
  const std::vector<AtomClass> classes = probe_classes(structure);
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
    atom.acceptor = is_acceptor(c) || is_face(structure, i, c) || is_unknown_nitrogen(structure, i);
    if (atom.donor || atom.acceptor) atom.charge = charges.of(i);
    atoms.push_back(std::move(atom));
  }
  return atoms;
}

}  // namespace hinge::molecular
