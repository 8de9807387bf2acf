// SPDX-License-Identifier: BSD-3-Clause
// Assigns RDKit's radii, to which PoseBusters compares distances.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "chemistry/atom_traits.hpp"

namespace hinge::molecular {

namespace {

/// Radii of RDKit's periodic table, angstrom.
struct Element {
  std::string_view symbol;
  double covalent;
  double van_der_waals;
  bool ion = false;  ///< PoseBusters' "inorganic cofactor" if it is a residue of its own
};

Element element_of(std::string_view symbol) {
  static constexpr std::array<Element, 38> table{{
      {"H", 0.23, 1.2},         {"B", 0.83, 1.8},        {"C", 0.68, 1.7},        {"N", 0.68, 1.6},
      {"O", 0.68, 1.55},        {"F", 0.64, 1.5},        {"Si", 1.2, 2.1},        {"P", 0.75, 1.95},
      {"S", 1.02, 1.8},         {"Cl", 0.99, 1.8, true}, {"As", 1.21, 2.05},      {"Se", 1.22, 1.9},
      {"Br", 1.21, 1.9, true},  {"I", 1.4, 2.1, true},   {"Li", 0.68, 2.2, true}, {"Be", 0.35, 1.9, true},
      {"Na", 0.97, 2.4, true},  {"Mg", 1.1, 2.2, true},  {"Al", 1.35, 2.1},       {"K", 1.33, 2.8, true},
      {"Ca", 0.99, 2.4, true},  {"V", 1.33, 2.05},       {"Cr", 1.35, 2.05},      {"Mn", 1.35, 2.05, true},
      {"Fe", 1.34, 2.05, true}, {"Co", 1.33, 2.0, true}, {"Ni", 1.5, 2.0, true},  {"Cu", 1.52, 2.0, true},
      {"Zn", 1.45, 2.1, true},  {"Rb", 1.47, 2.9, true}, {"Sr", 1.12, 2.55},      {"Mo", 1.47, 2.1},
      {"Ag", 1.59, 2.1},        {"Cd", 1.69, 2.2},       {"Cs", 1.67, 3.0},       {"Ba", 1.34, 2.7},
      {"Pt", 1.5, 2.05},        {"Hg", 1.7, 2.05},
  }};
  const auto found = std::find_if(table.begin(), table.end(), [&](const Element& e) { return e.symbol == symbol; });
  return found != table.end() ? *found : Element{symbol, 1.5, 2.0};  // RDKit's radii of most other heavy elements
}

}  // namespace

std::vector<AtomTraits> posebusters_atoms(const Structure& structure) {
  std::vector<AtomTraits> atoms;
  atoms.reserve(structure.atoms.size());
  for (const Atom& named : structure.atoms) {
    const Element element = element_of(named.element);
    const Residue& residue = structure.residues[named.residue];
    AtomTraits atom;
    atom.name = named.element;
    atom.radius = element.van_der_waals;
    atom.covalent_radius = element.covalent;
    atom.ion = element.ion && residue.last_atom - residue.first_atom == 1;
    atom.ignored = named.element == "H";
    atoms.push_back(std::move(atom));
  }
  return atoms;
}

}  // namespace hinge::molecular
