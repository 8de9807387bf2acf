// SPDX-License-Identifier: BSD-3-Clause
// Reads the heavy-atom bonds of monomers in Debian's refmac-dictionary with a minimal reader, independent of the CIF
// parser.
#pragma once

#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

namespace hinge::test {

/// Folder of refmac-dictionary, which may not exist.
inline const std::filesystem::path dictionary = "/usr/share/refmac/monomers";

/// Returns the bonds between heavy atoms of a monomer, as pairs of atom names; empty if it is not in the dictionary.
inline std::set<std::set<std::string>> dictionary_bonds(const std::string& name) {
  std::set<std::string> hydrogens;
  std::set<std::set<std::string>> bonds;
  std::ifstream in(dictionary / std::string(1, static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])))) /
                   (name + ".cif"));
  const auto word = [](std::istream& words) {  // removes quotes and trailing blanks: "C5'" and "H5' " keep the prime
    std::string text;
    words >> std::ws;
    if (words.peek() == '"') {
      words.get();
      std::getline(words, text, '"');
      text.erase(text.find_last_not_of(' ') + 1);
    } else {
      words >> text;
    }
    return text;
  };
  std::string line, category;
  while (std::getline(in, line)) {
    if (line.starts_with("loop_")) category.clear();
    if (line.starts_with("_")) category = line.substr(0, line.find('.'));
    if (line.empty() || line[0] == '_' || line[0] == '#' || line.starts_with("loop_")) continue;
    std::istringstream words(line);
    word(words);  // skips the component's name
    const std::string a = word(words), b = word(words);
    if (category == "_chem_comp_atom" && b == "H") hydrogens.insert(a);
    if (category == "_chem_comp_bond" && !hydrogens.contains(a) && !hydrogens.contains(b)) bonds.insert({a, b});
  }
  return bonds;
}

}  // namespace hinge::test
