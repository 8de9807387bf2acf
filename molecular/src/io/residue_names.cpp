// SPDX-License-Identifier: BSD-3-Clause
// has_long_residue_names: what column 21 of a PDB file's atoms means.
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "chemistry/nucleotide_table.hpp"
#include "chemistry/residue_table.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

namespace {

bool is_polymer(std::string_view name) {
  return find_residue_template(name) != nullptr || find_nucleotide_template(name) != nullptr;
}

/// The columns of an atom record that name its residue.
struct Address {
  std::string_view name;  ///< columns 18-20
  char column21;
  char column22;
  std::optional<int> number;  ///< columns 23-26

  static std::optional<Address> of(std::string_view line) {
    if (!is_atom_record(line) || line.size() < 26) return std::nullopt;
    Address address{line.substr(17, 3), line[20], line[21], std::nullopt};
    std::string_view digits = line.substr(22, 4);
    digits.remove_prefix(std::min(digits.find_first_not_of(' '), digits.size()));
    int number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error == std::errc{} && end == digits.data() + digits.size()) address.number = number;
    return address;
  }
};

/// True if one residue follows the other in a chain and only one of them, not the amino acid or nucleotide `plain`, has
/// column 21.
bool is_long_beside(const Address& longer, const Address& plain) {
  return longer.column21 != ' ' && plain.column21 == ' ' && longer.column22 == plain.column22 && longer.number &&
         plain.number && std::abs(*longer.number - *plain.number) == 1 && is_polymer(plain.name);
}

}  // namespace

bool has_long_residue_names(std::string_view text) {
  std::map<std::pair<char, char>, std::set<std::string_view>> names;  // of chains with two characters
  std::optional<Address> last;                                        // of the atom before; none after TER or MODEL
  bool is_found = false;                                              // column 21 is used
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (is_record(line, "TER") || is_model_record(line) || is_endmdl(line)) last.reset();
    const std::optional<Address> address = Address::of(line);
    if (!address) continue;
    if (last && (is_long_beside(*address, *last) || is_long_beside(*last, *address))) return true;
    last = address;
    if (address->column21 == ' ') continue;
    if (address->name.find(' ') != std::string_view::npos) return false;
    is_found = true;
    names[{address->column21, address->column22}].insert(address->name);
  }
  for (const auto& [chain, found] : names)
    if (found.contains("HOH") || std::count_if(found.begin(), found.end(), is_polymer) > 1) return false;
  return is_found;
}

}  // namespace hinge::molecular
