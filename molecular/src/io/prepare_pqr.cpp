// SPDX-License-Identifier: BSD-3-Clause
// prepare_pqr: the text of a PQR file (APBS, PDB2PQR) as mmCIF, whose values may have any width.
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/core/vec3.hpp"
#include "io/hybrid36.hpp"
#include "io/model_scan.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

namespace {

/// An atom record. Names are parts of the file's text.
struct PqrAtom {
  std::string_view serial, name, residue, chain = {}, insertion_code = {};
  int number = 0;  ///< of the residue
  Vec3 position = Vec3::Zero();
  bool hetero = false;
  int model = 0;         ///< from 1
  std::size_t part = 0;  ///< number of TER, END and ENDMDL records before it

  bool is_beside(const PqrAtom& other) const {
    return model == other.model && part == other.part && chain == other.chain && number == other.number &&
           insertion_code == other.insertion_code;
  }
};

std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view separators = " \t\r";
  std::vector<std::string_view> words;
  for (std::size_t end = 0;;) {
    const std::size_t first = line.find_first_not_of(separators, end);
    if (first == std::string_view::npos) return words;
    end = std::min(line.find_first_of(separators, first), line.size());
    words.push_back(line.substr(first, end - first));
  }
}

std::string_view word(std::string_view line, std::size_t column, std::size_t width) {
  const std::vector<std::string_view> words = words_of(line.substr(std::min(column, line.size()), width));
  return words.empty() ? std::string_view() : words.front();
}

/// Numbers have at most nine digits before the point, which is what prepare_cif() accepts.
constexpr int limit = 1'000'000'000;

/// Returns the number that is the whole text, if its magnitude is below the limit.
std::optional<double> small_number(std::string_view text) {
  const std::optional<double> number = finite_number(text);
  return number && std::abs(*number) < limit ? number : std::nullopt;
}

/// Returns a serial number, which may be hybrid-36; 0: it is none.
int serial_of(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && end == text.data() + text.size()) return value > -limit && value < limit ? value : 0;
  return text.size() == 5 ? read_hybrid36(text).value_or(0) : 0;
}

/// Takes the chain, the number and the insertion code of a residue from the texts, of which the first may be empty or
/// hold all three ("A1001B"). Returns false if there is no number.
bool take_number(PqrAtom& atom, std::string_view chain, std::string_view number) {
  if (chain.empty() && !number.empty() && std::isalpha(static_cast<unsigned char>(number[0])) != 0) {
    chain = number.substr(0, 1);
    number.remove_prefix(1);
  }
  const char* const last = number.data() + number.size();
  const auto [end, error] = std::from_chars(number.data(), last, atom.number);
  if (error != std::errc{} || last - end > 1 || (end != last && std::isalpha(static_cast<unsigned char>(*end)) == 0))
    return false;
  atom.chain = chain;
  atom.insertion_code = number.substr(static_cast<std::size_t>(end - number.data()));
  return atom.number > -limit && atom.number < limit;
}

/// Takes x, y and z. Returns false if one of them is not a number.
bool take_position(PqrAtom& atom, const std::array<std::string_view, 3>& words) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::optional<double> x = small_number(words[k]);
    if (!x) return false;
    atom.position[static_cast<Eigen::Index>(k)] = *x;
  }
  return true;
}

/// Reads fields that blanks separate: record, serial, name, residue, chain or nothing, number, x, y, z, charge, radius.
/// What follows is not read.
std::optional<PqrAtom> by_blanks(std::string_view line) {
  const std::size_t record = line.find_first_of(" \t0123456789");  // a long serial number may follow without a blank
  const std::vector<std::string_view> words = words_of(line.substr(std::min(record, line.size())));
  for (const std::size_t number : {std::size_t{4}, std::size_t{3}}) {  // with a chain or without
    if (words.size() < number + 6 || !small_number(words[number + 4]) || !small_number(words[number + 5])) continue;
    PqrAtom atom{.serial = words[0], .name = words[1], .residue = words[2]};
    if (take_position(atom, {words[number + 1], words[number + 2], words[number + 3]}) &&
        take_number(atom, number == 4 ? words[3] : std::string_view(), words[number]))
      return atom;
  }
  return std::nullopt;
}

/// Reads the columns of a PDB file, whose fields may touch.
std::optional<PqrAtom> by_columns(std::string_view line) {
  PqrAtom atom{.serial = word(line, 6, 5), .name = word(line, 12, 4), .residue = word(line, 17, 4)};
  if (atom.name.empty() || atom.residue.empty() ||
      !take_position(atom, {word(line, 30, 8), word(line, 38, 8), word(line, 46, 8)}) ||
      !take_number(atom, word(line, 21, 1), word(line, 22, 5)))
    return std::nullopt;
  return atom;
}

/// True if mmCIF can hold all words of the line.
bool can_be_quoted(std::string_view line) {
  constexpr auto none = std::string_view::npos;
  return line.find('\0') == none && (line.find('"') == none || line.find('\'') == none);
}
std::string cif_text(std::string_view text) {
  const char mark = text.find('"') == std::string_view::npos ? '"' : '\'';
  return mark + std::string(text) + mark;
}

std::string identity_of(const PqrAtom& atom) {
  std::string text;
  for (const std::string_view name : {atom.name, atom.residue, atom.chain, atom.insertion_code})
    text.append(name) += ' ';
  return text + std::to_string(atom.number);
}

std::vector<PqrAtom> read_atoms(std::string_view text, const std::string& path) {
  std::vector<PqrAtom> atoms;
  ModelScan scan;
  int model = 0;
  std::size_t line_number = 0, parts = 0;
  while (!text.empty()) {
    const std::size_t length = text.find('\n');
    const std::string_view line = text.substr(0, length);
    text.remove_prefix(length == std::string_view::npos ? text.size() : length + 1);
    ++line_number;
    if (is_record(line, "TER") || is_end(line) || is_endmdl(line)) ++parts;
    if (!is_atom_record(line)) {
      scan.add(line, false, std::nullopt);
      continue;
    }
    std::optional<PqrAtom> atom;
    if (can_be_quoted(line)) {
      atom = by_blanks(line);
      if (!atom) atom = by_columns(line);
    }
    if (!atom)
      throw LoadError(path + ":" + std::to_string(line_number) +
                      ": expected a record of PQR: ATOM serial name residue [chain] number x y z charge radius, "
                      "separated by blanks");
    atom->hetero = is_record(line, "HETA");
    atom->part = parts;
    if (scan.add(line, false, identity_of(*atom)) == ModelScan::Step::begin) ++model;
    atom->model = model;
    atoms.push_back(*atom);
  }
  if (atoms.empty()) throw LoadError(path + ": has no ATOM or HETATM records, expected a PQR file");
  return atoms;
}

/// With CHARMM's names, PDB2PQR gives some atoms of a residue the name of a patch: THR 5 begins with N and CA of TER 5.
/// Where names of residues of one number take turns, all atoms get the most frequent one.
void unite_residues(std::vector<PqrAtom>& atoms) {
  for (auto begin = atoms.begin(), end = begin; begin != atoms.end(); begin = end) {
    end = std::find_if(begin, atoms.end(), [&](const PqrAtom& atom) { return !atom.is_beside(*begin); });
    std::map<std::string_view, std::ptrdiff_t> counts;
    std::size_t runs = 0;
    for (auto atom = begin; atom != end; ++atom) {
      ++counts[atom->residue];
      if (atom == begin || atom->residue != std::prev(atom)->residue) ++runs;
    }
    if (runs == counts.size()) continue;
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    for (auto atom = begin; atom != end; ++atom) atom->residue = most->first;
  }
}

}  // namespace

bool is_pqr(std::filesystem::path path) {
  if (path.extension() == ".gz") path.replace_extension();
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension == ".pqr";
}

std::string pqr_as_cif(std::string_view text, const std::string& path) {
  std::vector<PqrAtom> atoms = read_atoms(text, path);
  unite_residues(atoms);
  std::string cif = "data_\nloop_\n";
  for (const char* tag :
       {"group_PDB", "id", "label_atom_id", "label_comp_id", "label_asym_id", "label_seq_id", "auth_asym_id",
        "auth_seq_id", "pdbx_PDB_ins_code", "Cartn_x", "Cartn_y", "Cartn_z", "pdbx_PDB_model_num"})
    cif += "_atom_site." + std::string(tag) + '\n';
  for (const PqrAtom& atom : atoms) {
    cif += atom.hetero ? "HETATM " : "ATOM ";
    cif += std::to_string(serial_of(atom.serial)) + ' ' + cif_text(atom.name) + ' ' + cif_text(atom.residue) + " . " +
           std::to_string(atom.part) + ' ' + (atom.chain.empty() ? "''" : cif_text(atom.chain)) + ' ' +
           std::to_string(atom.number) + ' ' + (atom.insertion_code.empty() ? "?" : std::string(atom.insertion_code));
    for (const double x : atom.position) cif += ' ' + number_text(x);
    cif += ' ' + std::to_string(atom.model) + '\n';
  }
  return cif;
}

}  // namespace hinge::molecular
