// SPDX-License-Identifier: BSD-3-Clause
// read_structure: reads the bytes, checks and parses them, assembles a structure and finds its bonds.
#include "hinge/molecular/read_structure.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/molecular/bonds.hpp"
#include "io/model_scan.hpp"
#include "io/read_file.hpp"
#include "io/unpacked_file.hpp"

namespace hinge::molecular {

// The first word of an mmCIF file that is not a comment is data_..., loop_ or an item; PDB lines start otherwise.
bool looks_like_cif(const std::string& bytes) {
  std::size_t line = 0;
  while (line < bytes.size()) {
    const std::size_t end = std::min(bytes.find('\n', line), bytes.size());
    std::size_t k = line;
    while (k < end && std::isspace(static_cast<unsigned char>(bytes[k])) != 0) ++k;
    if (k < end && bytes[k] != '#')
      return bytes.compare(k, 5, "data_") == 0 || bytes.compare(k, 5, "loop_") == 0 || bytes[k] == '_';
    line = end + 1;
  }
  return false;
}

namespace {

/// Limit of the unpacked size: harmless + most_times * bytes read. Structures shrink 4 to 10 times, equal models of a
/// small molecule 109 times (84 times if one side chain moves); a file made to fill the memory shrinks 1000 times.
constexpr std::size_t harmless = std::size_t{64} << 20, most_times = 200;

std::string stem(std::filesystem::path path) {
  if (path.extension() == ".gz") path.replace_extension();
  return path.stem().string();
}

/// Finds the end of a PDB file's first model in text that arrives in pieces, if another model follows.
class FirstModel {
 public:
  /// Returns the offset of the model's end, or npos if it is unknown or nothing follows so far.
  std::size_t end(std::string_view text) {
    for (std::size_t line_end = 0; (line_end = text.find('\n', next_)) != std::string_view::npos;
         next_ = line_end + 1) {
      const std::string_view line = text.substr(next_, line_end - next_);
      const bool was_inside = scan_.is_inside();
      const ModelScan::Step step = scan_.add_pdb(line, is_model_record(line));
      if (step == ModelScan::Step::begin && end_ != std::string_view::npos) return end_;
      if (step == ModelScan::Step::resume) end_ = std::string_view::npos;
      if (was_inside && !scan_.is_inside()) end_ = line_end + 1;
    }
    return std::string_view::npos;
  }

 private:
  ModelScan scan_;
  std::size_t end_ = std::string_view::npos;
  std::size_t next_ = 0;  // offset of the next line
};

/// Removes whole lines from the start of `text` and appends CONECT records, which follow all models, to `bytes`.
void move_conect(std::string& text, std::string& bytes) {
  std::size_t line = 0;
  for (std::size_t end = 0; (end = text.find('\n', line)) != std::string::npos; line = end + 1)
    if (text.compare(line, 6, "CONECT") == 0) bytes.append(text, line, end + 1 - line);
  text.erase(0, line);
}

}  // namespace

std::string read_bytes(const std::filesystem::path& path, bool first_model, bool* cut_short) {
  UnpackedFile file(path);
  std::string bytes, rest;  // rest: text after the first model, not yet searched for CONECT
  FirstModel first;
  bool behind = false;
  std::size_t total = 0;
  std::array<char, 1U << 16> chunk{};
  while (const std::size_t got = file.read(chunk)) {
    (behind ? rest : bytes).append(chunk.data(), got);
    total += got;
    // Plain files never exceed this: total equals the bytes read.
    if (const std::uint64_t read = file.packed(); total > harmless + most_times * read)
      throw LoadError(path.string() + ": " + std::to_string(read) + " bytes unpack to more than " +
                      std::to_string(total) + ", expected at most 64 MiB + " + std::to_string(most_times) +
                      " times as many; if the file is right, unpack it first");
    if (const std::size_t end = first_model && !behind ? first.end(bytes) : std::string::npos;
        end != std::string::npos) {
      rest = bytes.substr(end);
      bytes.resize(end);
      behind = true;
      if (cut_short != nullptr) *cut_short = true;
    }
    if (behind) move_conect(rest, bytes);
  }
  if (behind) move_conect(rest += '\n', bytes);
  if (bytes.find_first_not_of(" \t\r\n") == std::string::npos)
    throw LoadError(path.string() + ": is empty, expected a PDB or mmCIF file");
  return bytes;
}

RawFile read_raw(const std::string& bytes, const std::filesystem::path& path, bool first_model, bool* cut_short) {
  const bool cif = looks_like_cif(bytes), pqr = !cif && is_pqr(path);
  std::vector<std::string> notes;
  if (pqr)
    notes.emplace_back("PQR file: its charges and radii are not used");
  else if (!cif)
    check_pdb(bytes, path.string(), 0, &notes);
  RawFile raw = parse_with_gemmi(pqr ? pqr_as_cif(bytes, path.string()) : bytes, path.string(), cif || pqr);
  raw.notes.insert(raw.notes.end(), notes.begin(), notes.end());
  if (!cif) {
    raw.conect = read_conect(bytes);
    if (!pqr) raw.recorded = read_recorded(bytes, raw.conect);
  }
  if (raw.name.empty() || raw.name == path.string()) raw.name = stem(path);
  if (first_model && raw.models.size() > 1) {
    raw.models.resize(1);
    if (cut_short != nullptr) *cut_short = true;
  }
  return raw;
}

Structure read_structure(const std::filesystem::path& path, const ReadOptions& options) {
  bool cut_short = false;
  const bool first_model = options.first_model && !options.model;
  const std::string bytes = read_bytes(path, first_model, &cut_short);
  RawFile raw = read_raw(bytes, path, first_model, &cut_short);
  ComponentLibrary components(options.dictionary);
  for (const std::filesystem::path& file : options.components) components.add_file(file);
  for (Component& component : raw.components) components.add(std::move(component));
  const std::optional<RecordedBonds> recorded = raw.recorded;
  Structure structure;
  try {
    structure = assemble(std::move(raw), path.string(), options);
  } catch (const OtherAtoms&) {
    structure = assemble_common(read_raw(bytes, path), path.string(), options);
  }
  structure.more_models = cut_short;
  if (recorded && recorded->atoms == structure.atom_records)
    take_recorded_bonds(structure, *recorded);
  else
    perceive_bonds(structure, std::move(components), options.bonds);
  return structure;
}

}  // namespace hinge::molecular
