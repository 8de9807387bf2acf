// SPDX-License-Identifier: BSD-3-Clause
// bearers_by_name: infers from a hydrogen's name which atom it is bonded to.
#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

#include "chemistry/nucleotide_table.hpp"
#include "chemistry/residue_bonds.hpp"

namespace hinge::molecular {

namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Returns the heavy atoms of residue r for whose names matches(name) is true.
template <class Matches>
std::vector<std::uint32_t> heavy_atoms(const Structure& s, std::uint32_t r, const Matches& matches) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = s.residues[r].first_atom; i < s.residues[r].last_atom; ++i)
    if (s.atoms[i].element != "H" && matches(std::string_view(s.atoms[i].name))) found.push_back(i);
  return found;
}

/// Returns the heavy atoms whose name after the element is `locant`, or else its longest prefix that some atom has.
std::vector<std::uint32_t> with_locant(const Structure& s, std::uint32_t r, std::string_view locant) {
  for (; !locant.empty(); locant.remove_suffix(1)) {
    auto found = heavy_atoms(s, r, [&](std::string_view name) { return !name.empty() && name.substr(1) == locant; });
    if (!found.empty()) return found;
  }
  return {};
}

std::vector<std::uint32_t> in_amino_acid(const Structure& s, std::uint32_t r, std::string_view locant) {
  const auto exactly = [&](std::string_view wanted) {
    return heavy_atoms(s, r, [&](std::string_view name) { return name == wanted; });
  };
  if (locant == "XT" || locant == "O") return exactly("OXT");
  const bool amino = locant.empty() || is_digit(locant.front()) || locant.front() == 'N' || locant.front() == 'T';
  return amino ? exactly("N") : with_locant(s, r, locant);
}

/// H5', H5'', H5'1, HO2', HO'2 and H5T are on the sugar, HOP2 on the phosphate; digits alone mean the base.
std::vector<std::uint32_t> in_nucleotide(const Structure& s, std::uint32_t r, std::string_view locant) {
  const auto digit = std::find_if(locant.begin(), locant.end(), is_digit);
  if (digit == locant.end()) return {};
  const bool oxygen = locant.find('O') != std::string_view::npos, end = locant.ends_with('T');
  const bool sugar = locant.find_first_of("'*") != std::string_view::npos || end;
  std::string today{oxygen || end ? 'O' : 'C', *digit, '\''};
  if (locant.starts_with("OP")) today = std::string("OP") + *digit;
  if (sugar || locant.starts_with("OP"))
    return heavy_atoms(s, r, [&](std::string_view name) { return is_nucleotide_atom(name, today); });
  return with_locant(s, r, locant);
}

}  // namespace

std::vector<std::uint32_t> bearers_by_name(const Structure& s, std::uint32_t hydrogen) {
  std::string_view name = s.atoms[hydrogen].name;
  name.remove_prefix(std::min(name.find_first_not_of("0123456789"), name.size()));  // "1HB": one of several HB
  if (name.empty() || (name.front() != 'H' && name.front() != 'D')) return {};
  name.remove_prefix(1);
  const std::uint32_t r = s.atoms[hydrogen].residue;
  if (s.residues[r].kind == ResidueKind::amino_acid) return in_amino_acid(s, r, name);
  if (s.residues[r].kind == ResidueKind::nucleotide) return in_nucleotide(s, r, name);
  return {};
}

}  // namespace hinge::molecular
