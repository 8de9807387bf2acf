// SPDX-License-Identifier: BSD-3-Clause
// Refusals that need the text of a PDB file: what a lenient parser turns into zeros.
#include <charconv>
#include <set>
#include <string>
#include <string_view>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "read_file.hpp"

namespace hinge::molecular {

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

void check_coordinates(std::string_view line, const std::string& where) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t column = 30 + 8 * k;
    const std::string_view field = trimmed(line.size() > column ? line.substr(column, 8) : std::string_view());
    const std::string what = where + ": atom " + std::string(trimmed(line.substr(6, 5))) + " " +
                             std::string(trimmed(line.substr(12, 4))) + ": coordinate " + "xyz"[k];
    const std::string expected =
        ", expected a number in columns " + std::to_string(column + 1) + "-" + std::to_string(column + 8);
    if (field.empty()) throw LoadError(what + " is blank" + expected);
    double value = 0.0;
    const std::string_view digits = field.front() == '+' ? field.substr(1) : field;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || !is_finite(value))
      throw LoadError(what + " is '" + std::string(field) + "'" + expected);
  }
}

}  // namespace

void check_pdb(const std::string& text, const std::string& path) {
  std::size_t number = 0, atoms = 0;
  std::set<std::string_view> models;
  std::size_t open_model = 0;  // its line; 0: none is open
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n');
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    ++number;
    const std::string where = path + ":" + std::to_string(number);
    if (line.starts_with("ATOM  ") || line.starts_with("HETATM")) {
      if (line.size() < 30)
        throw LoadError(where + ": atom record of " + std::to_string(line.size()) +
                        " characters, expected coordinates in columns 31-54");
      check_coordinates(line, where);
      ++atoms;
    } else if (line.starts_with("MODEL ")) {
      const std::string_view name = trimmed(line.substr(6));
      if (open_model != 0)
        throw LoadError(where + ": MODEL " + std::string(name) + " begins, but the one of line " +
                        std::to_string(open_model) + " has no ENDMDL");
      if (!models.insert(name).second) throw LoadError(where + ": MODEL " + std::string(name) + " is there twice");
      open_model = number;
    } else if (line.starts_with("ENDMDL")) {
      open_model = 0;
    }
  }
  if (atoms == 0) throw LoadError(path + ": no ATOM or HETATM record in " + std::to_string(number) + " lines");
  if (open_model != 0)
    throw LoadError(path + ":" + std::to_string(open_model) + ": MODEL has no ENDMDL, the file may be cut short");
}

}  // namespace hinge::molecular
