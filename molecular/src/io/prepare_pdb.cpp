// SPDX-License-Identifier: BSD-3-Clause
// The text of a PDB file as the parser gets it.
#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/hybrid36.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

namespace {

/// gemmi looks at four letters, of either case.
bool is_record(std::string_view line, std::string_view name) {
  return line.size() >= name.size() &&
         std::equal(name.begin(), name.end(), line.begin(), [](char a, char b) { return a == (b & ~0x20); });
}

}  // namespace

std::string prepare_pdb(const std::string& text, std::size_t columns, std::vector<int>& serials) {
  constexpr std::size_t length_column = 72;
  constexpr std::size_t most_atoms = 100000 + 26UL * 36 * 36 * 36 * 36;  // that gemmi reads from five columns
  serials.clear();
  std::string kept;
  kept.reserve(text.size());
  for (std::size_t first = 0; first < text.size();) {
    const std::size_t end = std::min(text.find('\n', first), text.size());
    std::string_view line = std::string_view(text).substr(first, end - first);
    line =
        line.substr(0, is_record(line, "LINK") || is_record(line, "SSBO") ? std::min(columns, length_column) : columns);
    kept += line;
    if ((is_record(line, "ATOM") || is_record(line, "HETA")) && line.size() > 11) {
      if (serials.size() == most_atoms)
        throw std::runtime_error("more than " + std::to_string(most_atoms) + " atoms, expected mmCIF of so many");
      const std::string number = hybrid36(serials.size());
      serials.push_back(read_hybrid36(line.substr(6, 5)).value_or(0));
      kept.replace(kept.size() - line.size() + 6, 5, std::string(5 - number.size(), ' ') + number);
    }
    if (end < text.size()) kept += '\n';
    first = end + 1;
  }
  return kept;
}

}  // namespace hinge::molecular
