// SPDX-License-Identifier: BSD-3-Clause
// Tables of nucleotides by the names of PDB format 3, CHARMM and AMBER.
#include "chemistry/nucleotide_table.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace hinge::molecular {

namespace {

constexpr std::array<NucleotideTemplate, 7> nucleotides{{
    {"A", "C1'-N9 N9-C8 C8-N7 N7-C5 C5-C6 C6-N6 C6-N1 N1-C2 C2-N3 N3-C4 C4-C5 C4-N9"},
    {"C", "C1'-N1 N1-C2 C2-O2 C2-N3 N3-C4 C4-N4 C4-C5 C5-C6 C6-N1"},
    {"G", "C1'-N9 N9-C8 C8-N7 N7-C5 C5-C6 C6-O6 C6-N1 N1-C2 C2-N2 C2-N3 N3-C4 C4-C5 C4-N9"},
    {"I", "C1'-N9 N9-C8 C8-N7 N7-C5 C5-C6 C6-O6 C6-N1 N1-C2 C2-N3 N3-C4 C4-C5 C4-N9"},
    {"T", "C1'-N1 N1-C2 C2-O2 C2-N3 N3-C4 C4-O4 C4-C5 C5-C7 C5-C6 C6-N1"},
    {"U", "C1'-N1 N1-C2 C2-O2 C2-N3 N3-C4 C4-O4 C4-C5 C5-C6 C6-N1"},
    {"PSU", "C1'-C5 N1-C2 C2-O2 C2-N3 N3-C4 C4-O4 C4-C5 C5-C6 C6-N1"},
}};

/// CHARMM's names, and modified nucleotides, with the base they derive from.
constexpr std::array<std::pair<std::string_view, std::string_view>, 25> parents{{
    {"ADE", "A"}, {"CYT", "C"}, {"GUA", "G"}, {"THY", "T"}, {"URA", "U"}, {"1MA", "A"}, {"A2M", "A"},
    {"6MZ", "A"}, {"MA6", "A"}, {"5MC", "C"}, {"OMC", "C"}, {"4AC", "C"}, {"CCC", "C"}, {"1MG", "G"},
    {"2MG", "G"}, {"7MG", "G"}, {"G7M", "G"}, {"M2G", "G"}, {"OMG", "G"}, {"5MU", "U"}, {"H2U", "U"},
    {"OMU", "U"}, {"4SU", "U"}, {"UR3", "U"}, {"5BU", "U"},
}};

/// Returns the base's letter in A, DA, RA, +A, and in AMBER's chain ends and lone nucleotides: A5, DA3, RAN.
std::string_view letter(std::string_view name) noexcept {
  if (name.size() >= 2 && (name.front() == 'D' || name.front() == 'R' || name.front() == '+')) name.remove_prefix(1);
  if (name.size() == 2 && (name[1] == '3' || name[1] == '5' || name[1] == 'N')) name.remove_suffix(1);
  return name.size() == 1 ? name : std::string_view();
}

const NucleotideTemplate* with_name(std::string_view name) noexcept {
  const auto found =
      std::find_if(nucleotides.begin(), nucleotides.end(), [&](const auto& t) { return t.name == name; });
  return found == nucleotides.end() ? nullptr : found;
}

}  // namespace

const NucleotideTemplate* find_nucleotide_template(std::string_view name) noexcept {
  if (const NucleotideTemplate* plain = with_name(letter(name))) return plain;
  for (const auto& [variant, parent] : parents)
    if (name == variant) return with_name(parent);
  return with_name(name);
}

bool is_nucleotide_atom(std::string_view name, std::string_view today) noexcept {
  if (name == today) return true;
  if (today == "OP1") return name == "O1P";
  if (today == "OP2") return name == "O2P";
  if (today == "OP3") return name == "O3P" || name == "O5T";
  if (today == "C7") return name == "C5M";
  return std::equal(name.begin(), name.end(), today.begin(), today.end(),
                    [](char a, char b) { return a == b || (a == '*' && b == '\''); });
}

}  // namespace hinge::molecular
