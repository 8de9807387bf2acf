// SPDX-License-Identifier: BSD-3-Clause
// The kind of a residue and the element of an atom, from names, records and neighbours.
#include <algorithm>
#include <array>
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

/// True for one ion whose residue is called as its element, with or without a digit: ZN, ZN2, FE2. In files without
/// elements, the columns of its name may tell another one: ` CA ` is a carbon, `CA  ` is calcium.
bool is_ion(const RawResidue& residue) {
  static constexpr std::array<std::string_view, 25> symbols{"LI", "NA", "MG", "AL", "CL", "CA", "CR", "MN", "FE",
                                                            "CO", "NI", "CU", "ZN", "BR", "RB", "SR", "AG", "CD",
                                                            "CS", "BA", "PT", "AU", "HG", "PB", "EU"};
  const std::string& name = residue.atoms.front().name;
  const std::string_view rest = std::string_view(residue.name).substr(std::min(name.size(), residue.name.size()));
  return std::find(symbols.begin(), symbols.end(), name) != symbols.end() && residue.name.starts_with(name) &&
         (rest.empty() || (rest.size() == 1 && rest[0] >= '1' && rest[0] <= '9')) &&
         std::all_of(residue.atoms.begin(), residue.atoms.end(), [&](const RawAtom& a) { return a.name == name; });
}

/// CHARMM's names of monatomic ions; their first letters are symbols of other elements.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> charmm_ions{
    {{"CLA", "Cl"}, {"SOD", "Na"}, {"POT", "K"}, {"CAL", "Ca"}, {"CES", "Cs"}}};

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
  if (atom.element_field == ElementField::extra_point) return true;
  if (!atom.element.empty()) return false;
  return kind == ResidueKind::water ? element_by_name(atom, residue).empty() : atom.name.rfind("LP", 0) == 0;
}

std::string element_by_name(const RawAtom& atom, const RawResidue& residue) {
  const std::string_view name = atom.name;
  for (const auto& [ion, element] : charmm_ions)
    if (name == ion && residue.name == ion) return std::string(element);
  if (is_ion(residue)) return {name[0], static_cast<char>(name[1] - 'A' + 'a')};
  const std::size_t letter = name.find_first_not_of("0123456789");
  const char c = letter == std::string_view::npos ? '\0' : name[letter];
  if (find_residue_template(residue.name) != nullptr || find_nucleotide_template(residue.name) != nullptr) {
    if (residue.name == "MSE" && name == "SE") return "Se";
    if (std::string_view("CNOSHP").find(c) != std::string_view::npos) return {c};
  }
  if (atom.element_field == ElementField::blank)
    for (const std::string_view symbol : {"CL", "BR", "FE", "MG", "MN", "ZN"})
      if (name.starts_with(symbol)) return {symbol[0], static_cast<char>(symbol[1] - 'A' + 'a')};
  if (!atom.element.empty()) return atom.element;
  if (std::string_view("CNOSPHF").find(c) != std::string_view::npos) return {c};
  return c == 'D' ? "H" : "";
}

}  // namespace hinge::molecular
