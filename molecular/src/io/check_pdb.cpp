// SPDX-License-Identifier: BSD-3-Clause
// check_pdb: refuses errors in the text of a PDB file that a lenient parser turns into zeros.
#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

std::optional<double> finite_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !is_finite(value)) return std::nullopt;
  return value;
}

Vec3 read_pdb_coordinates(std::string_view line, const std::string& path, std::size_t line_number) {
  const auto where = [&] { return path + ":" + std::to_string(line_number) + ": atom "; };
  if (line.size() < 30)
    throw LoadError(where() + "record of " + std::to_string(line.size()) +
                    " characters, expected coordinates in columns 31-54");
  Vec3 position;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t column = 30 + 8 * k;
    const std::string_view field = trimmed(line.size() > column ? line.substr(column, 8) : std::string_view());
    const auto refuse = [&](const std::string& what) {
      const std::size_t number = is_record(line, "ATOM") ? 5 : 6;  // ATOM leaves room for six digits, HETATM for five
      throw LoadError(where() + std::string(trimmed(line.substr(number, 11 - number))) + " " +
                      std::string(trimmed(line.substr(12, 4))) + ": coordinate " + "xyz"[k] + " is " + what +
                      ", expected a number in columns " + std::to_string(column + 1) + "-" +
                      std::to_string(column + 8));
    };
    if (field.empty()) refuse("blank");
    const std::optional<double> value = finite_number(field);
    if (!value) refuse("'" + std::string(field) + "'");
    position[static_cast<Eigen::Index>(k)] = *value;
  }
  return position;
}

void check_pdb(std::string_view text, const std::string& path, std::size_t number, std::vector<std::string>* notes) {
  const std::size_t lines_before = number;
  std::size_t atoms = 0, atoms_before = 0;  // atoms_before: at the start of the open model
  std::set<int> models;                     // model numbers
  std::size_t model_count = 0;
  std::string twice;                  // note about the first repeated number
  std::size_t open_model = 0;         // its line; 0: no model is open
  std::size_t longest = 0, last = 0;  // lengths of atom records without trailing blanks
  bool is_closed = false;             // by a record that follows all models
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    // The parser would end the line at the NUL and lose the next one.
    if (line.find('\0') != std::string_view::npos)
      throw LoadError(path + ":" + std::to_string(number) +
                      ": the line has a NUL character, expected the text of a PDB or mmCIF file");
    if (is_atom_record(line)) {
      read_pdb_coordinates(line, path, number);
      ++atoms;
      last = trimmed(line).size();
      longest = std::max(longest, last);
    } else if (is_model_record(line)) {
      const std::string where = path + ":" + std::to_string(number);
      const std::string_view name = trimmed(line.substr(std::min<std::size_t>(6, line.size())));
      if (open_model != 0)
        throw LoadError(where + ": MODEL " + std::string(name) + " begins, but the MODEL of line " +
                        std::to_string(open_model) + " has no ENDMDL");
      const int model = model_number(line, static_cast<int>(++model_count));
      if (!models.insert(model).second && twice.empty())
        twice = "line " + std::to_string(number) + ": MODEL " + std::to_string(model) +
                " occurs twice, so models are numbered by their position in the file";
      open_model = number;
      atoms_before = atoms;
    } else if (is_endmdl(line)) {
      if (open_model != 0 && atoms == atoms_before)
        throw LoadError(path + ":" + std::to_string(open_model) + ": the MODEL has no ATOM or HETATM record");
      open_model = 0;
    } else if (line.starts_with("CONECT") || line.starts_with("MASTER") || is_end(line)) {
      is_closed = true;
    }
  }
  if (!twice.empty() && notes != nullptr) notes->push_back(twice);
  if (atoms == 0)
    throw LoadError(path + ": no ATOM or HETATM record in " + std::to_string(number - lines_before) +
                    " lines, expected a PDB or mmCIF file");
  if (open_model == 0) return;
  const std::string what = ":" + std::to_string(open_model) + ": MODEL has no ENDMDL";
  const bool is_whole = is_closed || (notes != nullptr && model_count == 1 && last == longest);
  if (!is_whole) throw LoadError(path + what + ", the file may be cut short");
  if (notes != nullptr)
    notes->push_back("line " + std::to_string(open_model) + ": MODEL has no ENDMDL, the model ends with the file");
}

}  // namespace hinge::molecular
