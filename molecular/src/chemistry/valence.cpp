// SPDX-License-Identifier: BSD-3-Clause
// Valences: for amino acids and nucleotides by atom name, for other residues by bonds.
#include "chemistry/valence.hpp"

#include <algorithm>
#include <string_view>

#include "chemistry/residue_table.hpp"
#include "hinge/molecular/radii.hpp"
#include "rules/hydrogen_bonds.hpp"

namespace hinge::molecular {

namespace {

constexpr int tetrahedral = 4, planar = 3, linear = 2, terminal = 1;

class Valences {
 public:
  explicit Valences(const Structure& structure)
      : s_(structure),
        near_(covalent_neighbours(structure)),
        multiple_(structure.atoms.size(), false),
        classes_(classify_atoms(structure)),
        has_hydrogens_(has_hydrogens(structure)) {
    for (const Bond& bond : s_.bonds)
      if (bond.order == BondOrder::multiple) multiple_[bond.first] = multiple_[bond.second] = true;
  }

  Valence of(std::uint32_t i) const {
    const std::string_view element = s_.atoms[i].element;
    Valence v;
    if (element == "C")
      v = carbon(i);
    else if (element == "N")
      v = nitrogen(i);
    else if (element == "O")
      v = oxygen(i);
    else if (element == "S")
      v = sulphur(i);
    else if (element == "P")
      v = {4, tetrahedral};
    else if (element == "H" || element == "F" || element == "Cl" || element == "Br" || element == "I")
      v = {1, terminal};
    v.present = static_cast<int>(near_[i].size());
    return v;
  }

 private:
  const Residue& residue(std::uint32_t i) const { return s_.residues[s_.atoms[i].residue]; }
  std::string_view name(std::uint32_t i) const { return s_.atoms[i].name; }
  bool bears_hydrogen(std::uint32_t i) const {
    return std::any_of(near_[i].begin(), near_[i].end(), [&](std::uint32_t j) { return s_.atoms[j].element == "H"; });
  }
  bool is_sugar_or_phosphate(std::uint32_t i) const { return name(i).find_first_of("'*P") != std::string_view::npos; }

  Valence carbon(std::uint32_t i) const {
    constexpr Valence sp3{4, tetrahedral}, sp2{3, planar};
    const std::string_view of = pdb_residue_name(residue(i).name), atom = name(i);
    const bool planar_class = classes_[i] == AtomClass::carbon_aromatic || classes_[i] == AtomClass::carbon_carbonyl;
    if (residue(i).kind == ResidueKind::amino_acid) {
      if ((of == "ASP" && atom == "CG") || (of == "GLU" && atom == "CD")) return {3, planar, 0, true};
      return planar_class || ((of == "ARG" || of == "ARGN") && atom == "CZ") ? sp2 : sp3;
    }
    if (residue(i).kind == ResidueKind::nucleotide) {
      const bool methyl = near_[i].size() == 1 || atom == "C7" || atom == "C5M";
      return is_sugar_or_phosphate(i) || methyl ? sp3 : sp2;
    }
    return planar_class || multiple_[i] ? sp2 : sp3;
  }

  Valence nitrogen(std::uint32_t i) const {
    constexpr Valence amide{3, planar}, imine{2, planar}, amine{3, tetrahedral}, ammonium{4, tetrahedral};
    const std::string_view of = pdb_residue_name(residue(i).name), atom = name(i);
    if (residue(i).kind == ResidueKind::amino_acid) {
      if (of == "LYS" && atom == "NZ") return ammonium;
      if (!is_histidine(of) || atom == "N") return amide;
      if (has_hydrogens_) return bears_hydrogen(i) ? amide : imine;
      return atom == "ND1" ? amide : imine;
    }
    if (residue(i).kind == ResidueKind::nucleotide) {
      if (near_[i].size() != 2 || bears_hydrogen(i)) return amide;
      const bool purine = of.ends_with('G') || of.ends_with('I') || of == "GUA";
      const bool imide =
          of.ends_with('U') || (of.ends_with('T') && of != "CYT") || of == "PSU" || of == "URA" || of == "THY";
      const bool lacks_hydrogen = (purine && atom == "N1") || (imide && (atom == "N3" || atom == "N1"));
      return lacks_hydrogen && !has_hydrogens_ ? amide : imine;
    }
    if (multiple_[i]) return near_[i].size() >= 3 ? amide : near_[i].size() == 2 ? imine : Valence{1, linear};
    const bool beside_planar = std::any_of(near_[i].begin(), near_[i].end(), [&](std::uint32_t j) {
      return s_.atoms[j].element == "C" && carbon(j).shape == planar;
    });
    if (beside_planar) return amide;
    const bool of_carbon = std::all_of(near_[i].begin(), near_[i].end(), [&](std::uint32_t j) {
      return s_.atoms[j].element == "C" || s_.atoms[j].element == "H";
    });
    return of_carbon && (!has_hydrogens_ || near_[i].size() == 4) ? ammonium : amine;
  }

  Valence oxygen(std::uint32_t i) const {
    if (near_[i].size() != 1 || classes_[i] == AtomClass::oxygen_hydroxyl) return {2, tetrahedral};
    const std::string_view beside = s_.atoms[near_[i].front()].element;
    return beside == "P" || beside == "S" ? Valence{1, tetrahedral} : Valence{1, planar};
  }

  Valence sulphur(std::uint32_t i) const {
    if (near_[i].size() >= 4) return {4, tetrahedral};
    if (near_[i].size() == 3) return {3, tetrahedral};
    return near_[i].size() == 1 && multiple_[i] ? Valence{1, planar} : Valence{2, tetrahedral};
  }

  const Structure& s_;
  std::vector<std::vector<std::uint32_t>> near_;
  std::vector<bool> multiple_;
  std::vector<AtomClass> classes_;
  bool has_hydrogens_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> covalent_neighbours(const Structure& structure) {
  std::vector<std::vector<std::uint32_t>> near(structure.atoms.size());
  for (const Bond& bond : structure.bonds) {
    if (bond.order == BondOrder::coordination) continue;
    near[bond.first].push_back(bond.second);
    near[bond.second].push_back(bond.first);
  }
  return near;
}

std::vector<Valence> valences(const Structure& structure) {
  const Valences all(structure);
  std::vector<Valence> found;
  found.reserve(structure.atoms.size());
  for (std::uint32_t i = 0; i < structure.atoms.size(); ++i) found.push_back(all.of(i));
  return found;
}

std::vector<HydrogenBondRole> hydrogen_bond_roles(const Structure& structure) {
  return hydrogen_bond_roles(structure, covalent_neighbours(structure), valences(structure));
}

std::vector<HydrogenBondRole> hydrogen_bond_roles(const Structure& structure,
                                                  const std::vector<std::vector<std::uint32_t>>& near,
                                                  const std::vector<Valence>& all) {
  const auto is_polar = [&](std::uint32_t i) {
    const std::string_view element = structure.atoms[i].element;
    return element == "N" || element == "O" || element == "S";
  };
  std::vector<HydrogenBondRole> roles(structure.atoms.size());
  for (std::uint32_t i = 0; i < roles.size(); ++i) {
    if (structure.atoms[i].element == "H") {
      roles[i].donor = std::any_of(near[i].begin(), near[i].end(), is_polar);
    } else if (is_polar(i)) {
      const bool bears = std::any_of(near[i].begin(), near[i].end(),
                                     [&](std::uint32_t j) { return structure.atoms[j].element == "H"; });
      roles[i].donor = bears || all[i].present < all[i].bonds;
      roles[i].acceptor = all[i].bonds < all[i].shape;
    }
  }
  return roles;
}

}  // namespace hinge::molecular
