// SPDX-License-Identifier: BSD-3-Clause
// The kind of a residue and the element of an atom, from names, records and neighbours.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "chemistry/nucleotide_table.hpp"
#include "chemistry/residue_table.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

namespace {

/// C-N of a peptide is 1.33 angstrom, O3'-P 1.61; unbonded contacts of these atoms are above 2.4.
constexpr double polymer_bond_max = 2.0;

/// Finds an atom by its current name; is_nucleotide_atom does not alter names of amino acid atoms.
const RawAtom* find(const RawResidue& residue, std::string_view name) {
  const auto found = std::find_if(residue.atoms.begin(), residue.atoms.end(),
                                  [&](const RawAtom& a) { return is_nucleotide_atom(a.name, name); });
  return found == residue.atoms.end() ? nullptr : &*found;
}

bool has(const RawResidue& residue, std::string_view name) { return find(residue, name) != nullptr; }

bool bonded(const RawResidue& a, std::string_view name_a, const RawResidue& b, std::string_view name_b) {
  const RawAtom *i = find(a, name_a), *j = find(b, name_b);
  return i != nullptr && j != nullptr &&
         squared_norm(Vec3(i->position - j->position)) < polymer_bond_max * polymer_bond_max;
}

bool follows(const RawResidue& a, const RawResidue& b) {
  return a.chain == b.chain && (bonded(a, "C", b, "N") || bonded(a, "O3'", b, "P"));
}

bool is_in_polymer(const std::vector<RawResidue>& residues, std::size_t r) {
  const RawResidue& residue = residues[r];
  if (!residue.hetero || residue.name == "MSE") return true;
  if (r > 0 && follows(residues[r - 1], residue)) return true;
  if (r + 1 < residues.size() && follows(residue, residues[r + 1])) return true;
  for (std::size_t k = r + 1; k < residues.size() && residues[k].chain == residue.chain; ++k)
    if (!residues[k].hetero &&
        (find_residue_template(residues[k].name) != nullptr || find_nucleotide_template(residues[k].name) != nullptr))
      return true;
  return false;
}

/// CHARMM's names of monatomic ions; their first letters are symbols of other elements.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> charmm_ions{
    {{"CLA", "Cl"}, {"SOD", "Na"}, {"POT", "K"}, {"CAL", "Ca"}, {"CES", "Cs"}}};

/// Monatomic ions whose residue has the name of their element. In files without elements, the columns of the name may
/// tell another element: " CA " is carbon, "CA  " is calcium.
constexpr std::array<std::string_view, 25> named_ions{"Li", "Na", "Mg", "Al", "Cl", "Ca", "Cr", "Mn", "Fe",
                                                      "Co", "Ni", "Cu", "Zn", "Br", "Rb", "Sr", "Ag", "Cd",
                                                      "Cs", "Ba", "Pt", "Au", "Hg", "Pb", "Eu"};

/// Elements whose symbol, at the start of a name, means no other element.
constexpr std::array<std::string_view, 6> named_elements{"Cl", "Br", "Fe", "Mg", "Mn", "Zn"};

/// True if the name starts with the symbol in capitals.
bool starts_with_symbol(std::string_view name, std::string_view symbol) {
  return name.size() >= 2 && name[0] == symbol[0] && name[1] == (symbol[1] & ~0x20);
}

/// Returns the element of a monatomic ion: of CHARMM's names, or of residues such as ZN, ZN2 and FE2; empty otherwise.
std::string_view element_of_ion(const RawAtom& atom, const RawResidue& residue) {
  for (const auto& [ion, element] : charmm_ions)
    if (atom.name == ion && residue.name == ion) return element;
  const bool is_alone =
      std::all_of(residue.atoms.begin(), residue.atoms.end(), [&](const RawAtom& a) { return a.name == atom.name; });
  const std::string_view of = residue.name;
  if (!is_alone || atom.name.size() != 2 || !of.starts_with(atom.name)) return {};
  if (of.size() > 3 || (of.size() == 3 && (of[2] < '1' || of[2] > '9'))) return {};
  const auto found = std::find_if(named_ions.begin(), named_ions.end(),
                                  [&](std::string_view symbol) { return starts_with_symbol(atom.name, symbol); });
  return found == named_ions.end() ? std::string_view() : *found;
}

}  // namespace

ResidueKind residue_kind(const std::vector<RawResidue>& residues, std::size_t r) {
  const RawResidue& residue = residues[r];
  if (is_cap(residue.name)) return ResidueKind::other;
  if (residue.kind == ResidueKind::water) return ResidueKind::water;
  ResidueKind kind = ResidueKind::other;
  const bool sugar = has(residue, "C1'") && has(residue, "O3'") && has(residue, "C4'");
  if (find_residue_template(residue.name) != nullptr ||
      (has(residue, "N") && has(residue, "CA") && has(residue, "C") && has(residue, "O")))
    kind = ResidueKind::amino_acid;
  else if (residue.kind == ResidueKind::nucleotide ||
           (sugar && (has(residue, "P") || find_nucleotide_template(residue.name) != nullptr)))
    kind = ResidueKind::nucleotide;
  return kind == ResidueKind::other || is_in_polymer(residues, r) ? kind : ResidueKind::other;
}

bool is_dummy(const RawResidue& residue) {
  if (residue.name == "UNX" || residue.name == "DUM") return true;
  if (residue.atoms.size() != 1) return false;
  const std::string& name = residue.atoms.front().name;
  return name == "UNK" || name == "UNX" || name == "DUM";
}

bool is_virtual_site(const RawAtom& atom, const RawResidue& residue, ResidueKind kind) {
  if (atom.element_field == ElementField::virtual_site) return true;
  if (!atom.element.empty()) return false;
  return kind == ResidueKind::water ? element_by_name(atom, residue).empty() : atom.name.starts_with("LP");
}

std::optional<RawResidue> with_own_names(const RawResidue& residue) {
  const auto is_symbol = [&](const RawAtom& atom) {
    const std::string element = atom.element.empty() ? element_by_name(atom, residue) : atom.element;
    return std::equal(atom.name.begin(), atom.name.end(), element.begin(), element.end(),
                      [](char a, char b) { return a == b || a == (b & ~0x20); });
  };
  std::set<std::pair<std::string, char>> seen;
  std::set<std::string> repeated, taken;
  for (const RawAtom& atom : residue.atoms)
    if (!seen.emplace(atom.name, atom.altloc).second && is_symbol(atom)) repeated.insert(atom.name);
  if (repeated.empty()) return std::nullopt;
  for (const RawAtom& atom : residue.atoms) taken.insert(atom.name);
  RawResidue named = residue;
  std::map<std::pair<std::string, char>, int> numbers;
  for (RawAtom& atom : named.atoms) {
    if (!repeated.contains(atom.name)) continue;
    int& number = numbers[{atom.name, atom.altloc}];
    std::string name;
    do name = atom.name + std::to_string(++number);
    while (taken.contains(name));
    atom.name = std::move(name);
  }
  return named;
}

std::string element_by_name(const RawAtom& atom, const RawResidue& residue) {
  const std::string_view name = atom.name;
  if (const std::string_view ion = element_of_ion(atom, residue); !ion.empty()) return std::string(ion);
  const std::size_t letter = name.find_first_not_of("0123456789");
  const char c = letter == std::string_view::npos ? '\0' : name[letter];
  if (find_residue_template(residue.name) != nullptr || find_nucleotide_template(residue.name) != nullptr) {
    if (residue.name == "MSE" && name == "SE") return "Se";
    if (std::string_view("CNOSHP").find(c) != std::string_view::npos) return {c};
  }
  if (atom.element_field == ElementField::blank)
    for (const std::string_view symbol : named_elements)
      if (starts_with_symbol(name, symbol)) return std::string(symbol);
  if (!atom.element.empty()) return atom.element;
  if (std::string_view("CNOSPHF").find(c) != std::string_view::npos) return {c};
  if ((c == 'I' || c == 'K') && name.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ", letter + 1) == std::string_view::npos)
    return {c};
  return c == 'D' ? "H" : "";
}

}  // namespace hinge::molecular
