// SPDX-License-Identifier: BSD-3-Clause
// prepare_pdb: the text of a PDB file as the parser receives it.
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/hybrid36.hpp"
#include "io/model_scan.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// True for an atom of a PDBQT file: columns 67-76 hold its partial charge, a number with a point. In a PDB file, they
/// are blank or end with the name of a segment.
bool has_charge(std::string_view line) {
  std::string_view field = line.substr(std::min<std::size_t>(66, line.size()), 10);
  field.remove_prefix(std::min(field.find_first_not_of(' '), field.size()));
  return finite_number(field) && field.find('.') != std::string_view::npos;
}

/// True for a pseudo atom of a PDBQT file: the partner of an atom in a macrocycle that docking opens (G0 to G3), a
/// water (W), a site around zinc (TZ).
bool is_pseudo_atom(std::string_view line) {
  const std::string_view type = line.substr(std::min<std::size_t>(77, line.size()), 2);
  constexpr std::array<std::string_view, 7> types{"G0", "G1", "G2", "G3", "TZ", "W", "W "};
  return std::find(types.begin(), types.end(), type) != types.end();
}

/// gemmi guesses the element if columns 77-78 have no letter.
ElementField element_field(std::string_view line) {
  const std::string_view field = line.substr(std::min<std::size_t>(76, line.size()), 2);
  if (field == "EP") return ElementField::virtual_site;
  return std::any_of(field.begin(), field.end(), is_letter) ? ElementField::symbol : ElementField::blank;
}

/// Returns the element that AutoDock's atom type means, as two columns; empty if the record has no such type. PDBQT
/// files have the type in columns 78-79 instead of an element in columns 77-78: "Cl", "OA" (an oxygen that accepts
/// hydrogen bonds), "A" (an aromatic carbon).
std::string element_of_type(std::string_view line) {
  if (line.size() < 78 || line[76] != ' ') return {};
  const char first = line[77], second = line.size() > 78 ? line[78] : ' ';
  if (first == 'A' && !is_letter(second)) return " C";
  if (!is_letter(first) || !is_letter(second)) return {};
  for (const char* symbol : {"BR", "CA", "CL", "FE", "MG", "MN", "ZN"})  // types that are also written in capitals
    if (line.substr(77, 2) == symbol) return symbol;
  const bool is_symbol = std::islower(static_cast<unsigned char>(second)) != 0;
  return is_symbol ? std::string{first, second} : std::string{' ', first};
}

/// Blanks the fourth letters of residue names in records of bonds and of secondary structure.
void blank_fourth_letters(std::string& text, std::size_t start) {
  struct LetterPair {
    const char* record;
    std::size_t first, second;  // offsets of the letters in the line
  };
  constexpr std::array<LetterPair, 4> all{{{"SSBO", 14, 28}, {"LINK", 20, 50}, {"HELI", 18, 30}, {"SHEE", 20, 31}}};
  for (const auto& [record, first, second] : all)
    if (is_record(std::string_view(text).substr(start), record))
      for (const std::size_t column : {first, second})
        if (start + column < text.size()) text[start + column] = ' ';
}

}  // namespace

int model_number(std::string_view line, int otherwise) {
  constexpr std::size_t name = 5;
  line.remove_prefix(std::min(line.find_first_not_of(' ', name), line.size()));
  std::from_chars(line.data(), line.data() + line.size(), otherwise);
  return otherwise;
}

void number_by_position_if_repeated(std::vector<int>& numbers) {
  std::vector<int> sorted = numbers;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) std::iota(numbers.begin(), numbers.end(), 1);
}

PreparedPdb prepare_pdb(const std::string& text, std::size_t columns) {
  constexpr std::size_t length_column = 72;
  const bool has_long_names = has_long_residue_names(text);
  constexpr std::size_t most_atoms = 100000 + 26UL * 36 * 36 * 36 * 36;  // that gemmi reads from five columns
  PreparedPdb result;
  std::vector<int>& serials = result.fields.serials;
  std::string& kept = result.text;
  kept.reserve(text.size());
  ModelScan scan;
  int model = 1;            // number of the open model
  bool is_counted = false;  // the open model has an atom
  std::size_t ters = 0, lines = 0;
  std::size_t end_at = std::string::npos, end_line = 0;  // of the last END in a model: offset in `kept`, line
  for (std::size_t first = 0; first < text.size();) {
    const std::size_t end = std::min(text.find('\n', first), text.size());
    std::string_view line = std::string_view(text).substr(first, end - first);
    line =
        line.substr(0, is_record(line, "LINK") || is_record(line, "SSBO") ? std::min(columns, length_column) : columns);
    const bool is_model = is_model_record(line);
    const int next = static_cast<int>(result.fields.model_numbers.size()) + 1;
    ++lines;
    const bool was_inside = scan.is_inside();
    const ModelScan::Step step = scan.add_pdb(line, is_model);
    if (step == ModelScan::Step::begin) {
      if (end_at != std::string::npos) kept.replace(end_at, 6, "ENDMDL");
      is_counted = false;
      model = is_model ? model_number(line, next) : next;
    }
    if (step == ModelScan::Step::resume && result.joined_at == 0) result.joined_at = end_line;
    if (step != ModelScan::Step::none || is_endmdl(line)) end_at = std::string::npos;
    if (was_inside && is_end(line)) {
      end_at = kept.size();
      end_line = lines;
    }
    if (is_record(line, "TER")) ++ters;
    const std::size_t start = kept.size();
    kept += is_model || is_end(line) ? "REMARK" : line;
    if (has_long_names) blank_fourth_letters(kept, start);
    if (is_atom_record(line) && line.size() > 11) {
      if (!is_counted) result.fields.model_numbers.push_back(model);
      is_counted = true;
      result.fields.ters.push_back(ters);
      if (serials.size() == most_atoms)
        throw std::runtime_error("more than " + std::to_string(most_atoms) +
                                 " atoms, expected an mmCIF file for so many atoms");
      const bool is_pdbqt = has_charge(line);
      result.fields.elements.push_back(is_pdbqt && is_pseudo_atom(line) ? ElementField::virtual_site
                                                                        : element_field(line));
      const std::string number = hybrid36(serials.size());
      serials.push_back(read_hybrid36(line.substr(6, 5)).value_or(0));
      result.fields.fourth_letters += has_long_names && line.size() > 20 ? line[20] : ' ';
      if (result.fields.fourth_letters.back() != ' ') kept[start + 20] = ' ';
      kept.replace(start + 6, 5, std::string(5 - number.size(), ' ') + number);
      if (is_pdbqt) {
        if (const std::string element = element_of_type(line); !element.empty()) kept.replace(start + 76, 3, element);
        kept.replace(start + 66, 10, 10, ' ');  // gemmi would split residues by segments there
      }
    }
    if (end < text.size()) kept += '\n';
    first = end + 1;
  }
  number_by_position_if_repeated(result.fields.model_numbers);
  return result;
}

}  // namespace hinge::molecular
