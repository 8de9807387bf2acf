// SPDX-License-Identifier: BSD-3-Clause
// prepare_pdb: the text of a PDB file as the parser receives it.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/hybrid36.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

namespace {

/// gemmi compares four letters, in either case.
bool is_record(std::string_view line, std::string_view name) {
  return line.size() >= name.size() &&
         std::equal(name.begin(), name.end(), line.begin(), [](char a, char b) { return a == (b & ~0x20); });
}

/// gemmi guesses the element if columns 77-78 have no letter.
ElementField element_field(std::string_view line) {
  const std::string_view field = line.substr(std::min<std::size_t>(76, line.size()), 2);
  if (field == "EP") return ElementField::extra_point;
  const bool has_letter = std::any_of(field.begin(), field.end(), [](unsigned char c) { return std::isalpha(c) != 0; });
  return has_letter ? ElementField::symbol : ElementField::blank;
}

}  // namespace

int model_number(std::string_view line, int otherwise) {
  constexpr std::size_t name = 5;
  line.remove_prefix(std::min(line.find_first_not_of(' ', name), line.size()));
  std::from_chars(line.data(), line.data() + line.size(), otherwise);
  return otherwise;
}

PreparedPdb prepare_pdb(const std::string& text, std::size_t columns) {
  constexpr std::size_t length_column = 72;
  constexpr std::size_t most_atoms = 100000 + 26UL * 36 * 36 * 36 * 36;  // that gemmi reads from five columns
  PreparedPdb result;
  std::vector<int>& serials = result.fields.serials;
  std::string& kept = result.text;
  kept.reserve(text.size());
  int model = 1;  // number of the open or the next model
  bool open = false;
  for (std::size_t first = 0; first < text.size();) {
    const std::size_t end = std::min(text.find('\n', first), text.size());
    std::string_view line = std::string_view(text).substr(first, end - first);
    line =
        line.substr(0, is_record(line, "LINK") || is_record(line, "SSBO") ? std::min(columns, length_column) : columns);
    const bool is_model = is_record(line, "MODE");
    const int next = static_cast<int>(result.fields.model_numbers.size()) + 1;
    if (is_model) model = model_number(line, next);
    if (ends_pdb_model(line)) {
      model = next;
      open = false;
    }
    kept += is_model ? "REMARK" : line;
    if ((is_record(line, "ATOM") || is_record(line, "HETA")) && line.size() > 11) {
      if (!open) result.fields.model_numbers.push_back(model);
      open = true;
      if (serials.size() == most_atoms)
        throw std::runtime_error("more than " + std::to_string(most_atoms) +
                                 " atoms, expected an mmCIF file for so many atoms");
      result.fields.elements.push_back(element_field(line));
      const std::string number = hybrid36(serials.size());
      serials.push_back(read_hybrid36(line.substr(6, 5)).value_or(0));
      kept.replace(kept.size() - line.size() + 6, 5, std::string(5 - number.size(), ' ') + number);
    }
    if (end < text.size()) kept += '\n';
    first = end + 1;
  }
  return result;
}

}  // namespace hinge::molecular
