// SPDX-License-Identifier: BSD-3-Clause
// prepare_cif: adds the columns of atom_site that the parser needs, and removes the categories that nobody reads.
#include "io/prepare_cif.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gemmi/cifdoc.hpp>
#include <gemmi/numb.hpp>

namespace hinge::molecular {

namespace {

const std::string atom_site = "_atom_site.";

bool is_read(const std::string& tag) {
  for (const char* category :
       {"_atom_site.", "_struct_conf.", "_struct_conn.", "_struct_sheet.", "_struct_sheet_range."})
    if (gemmi::istarts_with(tag, category)) return true;
  return false;
}

void check_whole_number(const std::string& tag, const std::string& value) {
  constexpr std::size_t most_digits = std::numeric_limits<int>::digits10;
  if (value.size() <= most_digits) return;  // nearly all values
  const std::string text = gemmi::cif::as_string(value);
  std::size_t first = std::min(text.find_first_not_of(" \t\n\v\f\r"), text.size());
  if (first < text.size() && (text[first] == '-' || text[first] == '+')) ++first;
  std::size_t end = first;
  while (end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
  // Whatever follows: gemmi also takes the digits before a fraction or a letter as a number.
  if (end - first > most_digits)
    throw std::runtime_error(tag + " is " + text + ", expected a number that starts with at most " +
                             std::to_string(most_digits) + " digits");
}

void keep_what_is_read(gemmi::cif::Block& block) {
  for (gemmi::cif::Item& item : block.items) {
    if (item.type == gemmi::cif::ItemType::Pair && is_read(item.pair[0])) {
      check_whole_number(item.pair[0], item.pair[1]);
    } else if (item.type == gemmi::cif::ItemType::Loop &&
               std::any_of(item.loop.tags.begin(), item.loop.tags.end(), is_read)) {
      for (std::size_t k = 0; k < item.loop.values.size(); ++k)
        check_whole_number(item.loop.tags[k % item.loop.tags.size()], item.loop.values[k]);
    } else {
      item.erase();
    }
  }
}

/// A column that gemmi needs, the column that has the same values (empty: none), and the value without either.
struct NeededColumn {
  const char *name, *substitute, *value;
};
constexpr NeededColumn needed_columns[] = {
    {"id", "", "0"},
    {"type_symbol", "", "?"},
    {"label_alt_id", "", "."},
    {"occupancy", "", "1.0"},
    {"B_iso_or_equiv", "", "0"},
    {"label_asym_id", "auth_asym_id", "."},
    {"Cartn_x", "", nullptr},
    {"Cartn_y", "", nullptr},
    {"Cartn_z", "", nullptr},
    {"auth_seq_id", "label_seq_id", nullptr},
};

/// Appends a column to the atoms, whether they are a loop or the pairs of a single atom.
void add_column(gemmi::cif::Block& block, gemmi::cif::Loop* loop, const NeededColumn& column) {
  const std::string tag = atom_site + column.name, other = atom_site + column.substitute;
  const std::string* pair = loop == nullptr ? block.find_value(other) : nullptr;
  const int source = loop == nullptr ? -1 : loop->find_tag(other);
  if (pair == nullptr && source < 0 && column.value == nullptr)
    throw std::runtime_error("has no " + tag + (*column.substitute == '\0' ? "" : " and no " + other) +
                             ", expected it for each atom");
  if (loop == nullptr) return block.set_pair(tag, pair != nullptr ? std::string(*pair) : column.value);
  std::vector<std::string> values;
  values.reserve(loop->values.size() + loop->length());
  for (std::size_t row = 0, width = loop->width(); row < loop->values.size(); row += width) {
    for (std::size_t k = 0; k < width; ++k) values.push_back(std::move(loop->values[row + k]));
    values.push_back(source < 0 ? column.value : values[values.size() - width + static_cast<std::size_t>(source)]);
  }
  loop->values = std::move(values);
  loop->tags.push_back(tag);
}

/// Returns true if the block has atoms.
bool complete_atoms(gemmi::cif::Block& block) {
  gemmi::cif::Loop* loop = nullptr;
  bool found = false;
  for (gemmi::cif::Item& item : block.items) {
    if (item.type == gemmi::cif::ItemType::Pair && gemmi::istarts_with(item.pair[0], atom_site)) found = true;
    if (item.type != gemmi::cif::ItemType::Loop || !gemmi::istarts_with(item.loop.tags.front(), atom_site)) continue;
    loop = &item.loop;
    found = true;
  }
  if (!found) return false;
  for (const NeededColumn& column : needed_columns)
    if (loop != nullptr ? !loop->has_tag(atom_site + column.name)
                        : block.find_value(atom_site + column.name) == nullptr)
      add_column(block, loop, column);
  return true;
}

}  // namespace

AtomFields prepare_cif(gemmi::cif::Document& document) {
  AtomFields fields;
  std::map<std::pair<std::string, std::string>, std::size_t> labels;
  bool has_components = false;
  for (gemmi::cif::Block& block : document.blocks) {
    has_components = has_components || block.find_mmcif_category("_chem_comp_atom.").ok();
    keep_what_is_read(block);
    if (!complete_atoms(block)) continue;
    gemmi::cif::Table atoms =
        block.find(atom_site, {"id", "type_symbol", "B_iso_or_equiv", "?label_asym_id", "?label_seq_id"});
    for (auto row : atoms) {
      fields.elements.push_back(row[1] == "EP"                   ? ElementField::virtual_site
                                : row[1] == "?" || row[1] == "." ? ElementField::blank
                                                                 : ElementField::symbol);
      fields.serials.push_back(gemmi::string_to_int(row[0], false));
      row[0] = std::to_string(fields.serials.size() - 1);
      // A B factor that is no number becomes 0, as in PDB files; gemmi would take 50.
      if (!std::isfinite(gemmi::cif::as_number(row[2]))) row[2] = "0";
      const auto value = [&](std::size_t column) { return row.has(column) ? row[column] : std::string(); };
      fields.labels.push_back(labels.emplace(std::pair(value(3), value(4)), labels.size()).first->second);
    }
  }
  if (fields.serials.empty())
    throw std::runtime_error(has_components
                                 ? "has no atoms of a structure (atom_site), only components, which --components takes"
                                 : "has no atoms, expected a CIF file with the category atom_site");
  return fields;
}

}  // namespace hinge::molecular
