// SPDX-License-Identifier: BSD-3-Clause
// Heavy-atom bonds of the monomers of Debian's refmac-dictionary, read by a few lines that know nothing of CIF.
#pragma once

#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

namespace hinge::test {

inline const std::filesystem::path dictionary = "/usr/share/refmac/monomers";

inline std::set<std::set<std::string>> dictionary_bonds(const std::string& name) {
  std::set<std::string> hydrogens;
  std::set<std::set<std::string>> bonds;
  std::ifstream in(dictionary / std::string(1, static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])))) /
                   (name + ".cif"));
  const auto word = [](std::istream& words) {  // "C5'" keeps its prime and loses its quotes; "H5' " its blank too
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
    word(words);  // the component
    const std::string a = word(words), b = word(words);
    if (category == "_chem_comp_atom" && b == "H") hydrogens.insert(a);
    if (category == "_chem_comp_bond" && !hydrogens.contains(a) && !hydrogens.contains(b)) bonds.insert({a, b});
  }
  return bonds;
}

}  // namespace hinge::test
