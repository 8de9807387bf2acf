// SPDX-License-Identifier: BSD-3-Clause
// Assigns atom classes by elements and bonds, so that any molecule gets them. Coordination to a metal does not change
// the class of a carbonyl or carboxylate.
#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "chemistry/residue_table.hpp"
#include "chemistry/valence.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/radii.hpp"
#include "hinge/molecular/structure.hpp"
#include "mechanism/rotatable_bonds.hpp"

namespace hinge::molecular {

namespace {

using Neighbours = std::vector<std::vector<std::uint32_t>>;

/// Returns true for aromatic carbons of amino acids. Aromatic rings of other residues count as aliphatic here; the
/// radii differ by 0.05 angstrom, in one set only.
bool is_aromatic(std::string_view residue, std::string_view atom) {
  residue = pdb_residue_name(residue);
  if (residue == "PHE" || residue == "TYR" || residue == "PTR")
    return atom == "CG" || atom == "CD1" || atom == "CD2" || atom == "CE1" || atom == "CE2" || atom == "CZ";
  if (residue == "TRP")
    return atom == "CG" || atom == "CD1" || atom == "CD2" || atom == "CE2" || atom == "CE3" || atom == "CZ2" ||
           atom == "CZ3" || atom == "CH2";
  return is_histidine(residue) && (atom == "CG" || atom == "CD2" || atom == "CE1");
}

AtomClass classify_oxygen(const Structure& s, const Neighbours& near, std::uint32_t i) {
  for (const std::uint32_t j : near[i])
    if (s.atoms[j].element == "H") return AtomClass::oxygen_hydroxyl;
  const std::string_view residue = pdb_residue_name(s.residues[s.atoms[i].residue].name), atom = s.atoms[i].name;
  bool hydroxyl =
      (residue == "SER" && atom == "OG") || (residue == "THR" && atom == "OG1") || (residue == "TYR" && atom == "OH");
  // If the file leaves out hydrogens, these are hydroxyl: oxygens of sugars, and terminal oxygens at single-bond
  // distance from carbon.
  const ResidueKind kind = s.residues[s.atoms[i].residue].kind;
  if (kind == ResidueKind::nucleotide && near[i].size() == 1) hydroxyl = atom.ends_with('\'') || atom.ends_with('*');
  if (kind == ResidueKind::other && near[i].size() == 1 && s.atoms[near[i].front()].element == "C")
    hydroxyl = norm(Vec3(s.models.front()[i] - s.models.front()[near[i].front()])) > single_carbon_oxygen;
  return hydroxyl ? AtomClass::oxygen_hydroxyl : AtomClass::oxygen;
}

AtomClass classify_carbon(const Structure& s, const Neighbours& near, std::uint32_t i) {
  if (is_aromatic(s.residues[s.atoms[i].residue].name, s.atoms[i].name)) return AtomClass::carbon_aromatic;
  for (const std::uint32_t j : near[i])
    if (s.atoms[j].element == "O" && near[j].size() == 1 && near[i].size() <= 3 &&
        classify_oxygen(s, near, j) == AtomClass::oxygen)
      return AtomClass::carbon_carbonyl;
  return AtomClass::carbon;
}

AtomClass classify_nitrogen(const Structure& s, const Neighbours& near, std::uint32_t i, bool has_hydrogens) {
  std::size_t heavy = 0;
  for (const std::uint32_t j : near[i]) {
    if (s.atoms[j].element == "H") return AtomClass::nitrogen;
    ++heavy;
  }
  // Without hydrogens in the file, the protonation is unknown and the hydrogen-bond rule does not apply.
  return heavy == 2 && has_hydrogens ? AtomClass::nitrogen_acceptor : AtomClass::nitrogen;
}

AtomClass classify_hydrogen(const Structure& s, const Neighbours& near, std::uint32_t i) {
  if (near[i].empty()) return AtomClass::hydrogen;
  const std::uint32_t bearer = near[i].front();
  const std::string_view element = s.atoms[bearer].element;
  if (element == "O") return AtomClass::hydrogen_hydroxyl;
  if (element == "N" || element == "S") return AtomClass::hydrogen_polar;
  if (is_aromatic(s.residues[s.atoms[bearer].residue].name, s.atoms[bearer].name)) return AtomClass::hydrogen_aromatic;
  const auto withdraws = [&](std::uint32_t j) {
    const std::string_view other = s.atoms[j].element;
    return other == "N" || other == "O" || other == "S";
  };
  return std::any_of(near[bearer].begin(), near[bearer].end(), withdraws) ? AtomClass::hydrogen_alpha
                                                                          : AtomClass::hydrogen;
}

}  // namespace

std::vector<AtomClass> classify_atoms(const Structure& structure) {
  const Neighbours near = covalent_neighbours(structure), bonded = bonded_neighbours(structure);
  const bool hydrogens = has_hydrogens(structure);
  std::vector<AtomClass> classes;
  classes.reserve(structure.atoms.size());
  for (std::uint32_t i = 0; i < structure.atoms.size(); ++i) {
    const std::string_view element = structure.atoms[i].element;
    AtomClass c = AtomClass::other;
    if (element == "C") c = classify_carbon(structure, near, i);
    if (element == "N") c = classify_nitrogen(structure, bonded, i, hydrogens);  // a metal uses the lone pair
    if (element == "O") c = classify_oxygen(structure, near, i);
    if (element == "S") c = AtomClass::sulphur;
    if (element == "P") c = AtomClass::phosphorus;
    if (element == "H") c = classify_hydrogen(structure, near, i);
    classes.push_back(c);
  }
  return classes;
}

}  // namespace hinge::molecular
