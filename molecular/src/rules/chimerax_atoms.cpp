// SPDX-License-Identifier: BSD-3-Clause
// Assigns ChimeraX's default radii: for atoms with explicit hydrogens, for united atoms and for ions.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chemistry/atom_traits.hpp"
#include "chemistry/valence.hpp"
#include "hinge/core/number_text.hpp"
#include "rules/hydrogen_bonds.hpp"

namespace hinge::molecular {

namespace {

/// Returns the radius (angstrom) of an atom with all its hydrogens present, or nothing if united_radius applies.
std::optional<double> explicit_radius(std::string_view element, const Valence& v) {
  if (element == "H") return 1.0;
  if (element == "C") return 1.7;
  if (element == "N") return 1.625;
  if (element == "O") return v.shape < 4 ? 1.48 : 1.5;
  if (element == "F") return 1.56;
  if (element == "P") return 1.871;
  if (element == "S") return 1.782;
  if (element == "Cl") return 1.735;
  if (element == "Br") return 1.978;
  if (element == "I") return 2.094;
  return std::nullopt;
}

/// Ionic radii by coordination number, angstrom (CRC Handbook 2001, charge +2 or the lowest listed charge).
struct Ion {
  std::string_view element;
  double up_to_four;
  double six;
  double from_eight;
};

double ionic_radius(std::string_view element, std::size_t coordination) {
  static constexpr std::array<Ion, 19> table{{
      {"Li", 0.59, 0.76, 0.92}, {"Na", 0.99, 1.02, 1.18}, {"Mg", 0.57, 0.72, 0.89}, {"Al", 0.39, 0.54, 0.54},
      {"K", 1.37, 1.38, 1.38},  {"Ca", 1.00, 1.00, 1.12}, {"Mn", 0.66, 0.83, 0.96}, {"Fe", 0.63, 0.61, 0.92},
      {"Co", 0.56, 0.65, 0.90}, {"Ni", 0.49, 0.69, 0.69}, {"Cu", 0.57, 0.73, 0.73}, {"Zn", 0.60, 0.74, 0.90},
      {"Se", 0.50, 0.50, 0.50}, {"Sr", 1.18, 1.18, 1.26}, {"Cd", 0.78, 0.95, 1.10}, {"Ba", 1.35, 1.35, 1.42},
      {"Pt", 0.60, 0.80, 0.80}, {"Au", 1.37, 1.37, 1.37}, {"Hg", 0.96, 1.02, 1.14},
  }};
  for (const Ion& ion : table)
    if (ion.element == element)
      return coordination <= 4 ? ion.up_to_four : coordination >= 8 ? ion.from_eight : ion.six;
  return 1.8;  // ChimeraX's default for all other elements
}

double united_radius(std::string_view element, const Valence& v, bool bears_hydrogen, std::size_t all_bonds) {
  if (element == "H") return 1.0;
  if (element == "C") {  // Tsai et al., J. Mol. Biol. 290:253 (1999); also for N, O, S
    if (v.shape == 4 || v.carboxylate) return 1.88;
    return v.present < 3 || bears_hydrogen ? 1.76 : 1.61;
  }
  if (element == "N") return 1.64;
  if (element == "O") return v.bonds == 2 ? 1.46 : 1.42;
  if (element == "S") return 1.77;
  if (element == "P") return 2.1;
  // Ions without bonds, otherwise twice the bond radius of Allen et al., Acta Cryst. B 35:2331 (1979).
  if (element == "F") return v.present == 0 ? 1.33 : 1.28;
  if (element == "Cl") return v.present == 0 ? 1.81 : 1.98;
  if (element == "Br") return v.present == 0 ? 1.96 : 2.42;
  if (element == "I") return v.present == 0 ? 2.2 : 2.8;
  return ionic_radius(element, all_bonds == 0 ? 6 : all_bonds);
}

}  // namespace

std::vector<AtomTraits> chimerax_atoms(const Structure& structure) {
  const auto near = covalent_neighbours(structure);
  const auto bonded = bonded_neighbours(structure);
  const std::vector<Valence> all = valences(structure);
  const std::vector<HydrogenBondRole> roles = hydrogen_bond_roles(structure, near, all);
  const auto is_hydrogen = [&](std::uint32_t i) { return structure.atoms[i].element == "H"; };
  const bool hydrogens = has_hydrogens(structure);
  std::vector<AtomTraits> atoms;
  atoms.reserve(structure.atoms.size());
  for (std::uint32_t i = 0; i < structure.atoms.size(); ++i) {
    const std::string_view element = structure.atoms[i].element;
    std::optional<double> radius;
    if (hydrogens && all[i].bonds <= all[i].present) radius = explicit_radius(element, all[i]);
    bool bears = false;
    for (const std::uint32_t j : near[i]) bears = bears || is_hydrogen(j);
    AtomTraits atom;
    atom.radius = radius.value_or(united_radius(element, all[i], bears, bonded[i].size()));
    atom.name = std::string(element) + '.' + number_text(atom.radius);
    atom.donor = roles[i].donor;
    atom.acceptor = roles[i].acceptor;
    atoms.push_back(std::move(atom));
  }
  return atoms;
}

}  // namespace hinge::molecular
