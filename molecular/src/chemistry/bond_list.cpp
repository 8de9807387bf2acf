// SPDX-License-Identifier: BSD-3-Clause
// BondList, covalent radii, and the list of elements that are not metals.
#include "chemistry/bond_list.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "chemistry/nucleotide_table.hpp"
#include "hinge/molecular/bonds.hpp"

namespace hinge::molecular {

namespace {

/// Closer atoms are two copies of one, as in doubled files (Open Babel's bound, angstrom).
constexpr double coincident_max = 0.4;

/// Contacts across a ligand's oxygen that the radii would call bonds: a metal ion and phosphorus, and an alkali or
/// alkaline earth ion and the carbon of a carboxylate.
bool is_contact(std::string_view ion, std::string_view other) {
  static constexpr std::array<std::string_view, 16> ions{"Li", "Na", "K",  "Rb", "Cs", "Mg", "Ca", "Sr",
                                                         "Ba", "Mn", "Fe", "Co", "Ni", "Cu", "Zn", "Cd"};
  constexpr std::ptrdiff_t alkaline = 9;  // number of alkali and alkaline earth ions in the list
  const auto last = other == "C" ? ions.begin() + alkaline : ions.end();
  return (other == "C" || other == "P") && std::find(ions.begin(), last, ion) != last;
}

std::uint64_t pair_key(std::uint32_t first, std::uint32_t second) { return (std::uint64_t{first} << 32) | second; }

}  // namespace

bool BondList::add(std::uint32_t i, std::uint32_t j, BondOrigin origin, BondOrder order) {
  const auto [a, b] = std::minmax(i, j);
  if (!seen_.insert(pair_key(a, b)).second) return false;
  if (is_metal(s_.atoms[a].element) || is_metal(s_.atoms[b].element)) order = BondOrder::coordination;
  s_.bonds.push_back({a, b, origin, order});
  return true;
}

bool BondList::has(std::uint32_t i, std::uint32_t j) const {
  return seen_.contains(pair_key(std::min(i, j), std::max(i, j)));
}

double BondList::radii(std::uint32_t i, std::uint32_t j) const {
  return covalent_radius(s_.atoms[i].element) + covalent_radius(s_.atoms[j].element);
}

bool BondList::within_radii(std::uint32_t i, std::uint32_t j) const {
  const std::string &a = s_.atoms[i].element, &b = s_.atoms[j].element;
  if (is_contact(a, b) || is_contact(b, a)) return false;
  const double d = distance(i, j);
  return d > coincident_max && d < radii(i, j) + tolerance;
}

std::optional<std::uint32_t> BondList::find(std::uint32_t r, std::string_view name) const {
  const Residue& residue = s_.residues[r];
  const bool nucleotide = residue.kind == ResidueKind::nucleotide;
  for (std::uint32_t i = residue.first_atom; i < residue.last_atom; ++i)
    if (nucleotide ? is_nucleotide_atom(s_.atoms[i].name, name) : s_.atoms[i].name == name) return i;
  return std::nullopt;
}

bool is_metal(const std::string& element) noexcept {
  static constexpr std::array<std::string_view, 21> others{"H",  "D", "B",  "C",  "N",  "O",  "F",
                                                           "Si", "P", "S",  "Cl", "As", "Se", "Br",
                                                           "Te", "I", "He", "Ne", "Ar", "Kr", "Xe"};
  return std::find(others.begin(), others.end(), element) == others.end();
}

double covalent_radius(const std::string& element) noexcept {
  static constexpr std::array<std::pair<std::string_view, double>, 33> table{{
      {"H", 0.31},  {"B", 0.84},  {"C", 0.76},  {"N", 0.71},  {"O", 0.66},  {"F", 0.57},  {"Na", 1.66},
      {"Mg", 1.41}, {"Al", 1.21}, {"Si", 1.11}, {"P", 1.07},  {"S", 1.05},  {"Cl", 1.02}, {"K", 2.03},
      {"Ca", 1.76}, {"V", 1.53},  {"Cr", 1.39}, {"Mn", 1.39}, {"Fe", 1.32}, {"Co", 1.26}, {"Ni", 1.24},
      {"Cu", 1.32}, {"Zn", 1.22}, {"As", 1.19}, {"Se", 1.20}, {"Br", 1.20}, {"Mo", 1.54}, {"Ag", 1.45},
      {"Cd", 1.44}, {"I", 1.39},  {"Pt", 1.36}, {"Au", 1.36}, {"Hg", 1.32},
  }};
  for (const auto& [symbol, radius] : table)
    if (symbol == element) return radius;
  return 1.5;  // a typical radius of heavier metals, which are rare here
}

}  // namespace hinge::molecular
