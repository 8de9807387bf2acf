// SPDX-License-Identifier: BSD-3-Clause
// PdbModels: finds models line by line and reads one at a time.
#include "io/pdb_models.hpp"

#include <optional>
#include <utility>

#include "hinge/core/error.hpp"
#include "io/model_scan.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

namespace {

constexpr std::size_t chunk_bytes = std::size_t{1} << 20;

/// Columns of an atom record that identify the atom: record name; atom and residue; occupancy; segment, element and
/// charge.
struct Columns {
  std::size_t first, count;
};
constexpr Columns identity[] = {{0, 6}, {12, 15}, {54, 6}, {72, 8}};
constexpr std::size_t identity_bytes = 35;

void append_identity(std::string& records, std::string_view line) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  for (const auto& [first, count] : identity) {
    const std::string_view part = line.size() > first ? line.substr(first, count) : std::string_view();
    records.append(part).append(count - part.size(), ' ');
  }
}

/// Calls use(line) for each line of a text.
template <class Use>
void for_lines(std::string_view text, const Use& use) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    use(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
}

}  // namespace

class PdbModels::Finder {
 public:
  explicit Finder(std::vector<Model>& models) : models_(models) {}

  /// Adds the next line, without its line end.
  void add(std::string_view line) {
    const bool is_model = is_model_record(line), was_inside = scan_.is_inside();
    if (scan_.add_pdb(line, is_model) == ModelScan::Step::begin) {
      const int position = static_cast<int>(models_.size()) + 1;
      models_.push_back({at_, at_, lines_, is_model ? model_number(line, position) : position});
    }
    at_ += line.size() + 1;
    ++lines_;
    if (was_inside || scan_.is_inside()) models_.back().end = at_;
  }

 private:
  std::vector<Model>& models_;
  std::uint64_t at_ = 0;
  std::size_t lines_ = 0;
  ModelScan scan_;
};

void PdbModels::find_models() {
  Finder finder(models_);
  std::string chunk;
  for (std::uint64_t at = 0; at < file_.size();) {
    const std::size_t kept = chunk.size();  // the start of an incomplete line
    chunk.resize(kept + chunk_bytes);
    const std::size_t got = file_.read(at, std::span(chunk).subspan(kept));
    if (got == 0) break;
    chunk.resize(kept + got);
    at += got;
    const std::size_t end = at < file_.size() ? chunk.rfind('\n') : chunk.size() - 1;
    if (end == std::string::npos) continue;
    for_lines(std::string_view(chunk).substr(0, end + 1), [&](std::string_view line) { finder.add(line); });
    chunk.erase(0, end + 1);
  }
  if (models_.empty()) throw LoadError(file_.name() + ": has no ATOM record, expected DCD, XTC, NumPy, PDB or mmCIF");
  std::vector<int> numbers;
  for (const Model& model : models_) numbers.push_back(model.number);
  number_by_position_if_repeated(numbers);
  for (std::size_t k = 0; k < models_.size(); ++k) models_[k].number = numbers[k];
}

PdbModels::PdbModels(BinaryFile file, const Structure& structure, const ReadOptions& options, bool may_have_more)
    : file_(std::move(file)), structure_(structure), options_(options), may_have_more_(may_have_more) {
  options_.model.reset();
  find_models();
  const std::string first = text(models_.front());
  const MatchedAtoms known = parsed(first, models_.front());
  std::vector<Vec3> all;
  for_lines(first, [&](std::string_view line) {
    if (!is_atom_record(line)) return;
    append_identity(records_, line);
    all.push_back(read_pdb_coordinates(line, file_.name(), 0));
  });
  // Direct reading is used only if it finds the positions that the parser found.
  for (std::size_t i = 0; i < known.records.size() && !records_.empty(); ++i) {
    kept_.push_back(known.records[i]);
    if (kept_[i] >= all.size() || all[kept_[i]] != known.positions[i]) records_.clear();
  }
}

std::string PdbModels::text(const Model& model) const {
  std::string text(static_cast<std::size_t>(model.end - model.begin), '\0');
  const std::size_t got = file_.read(model.begin, text);
  text.resize(got);  // the last line may have no line end
  return text;
}

MatchedAtoms PdbModels::parsed(const std::string& text, const Model& model) const {
  std::vector<std::string> notes;
  check_pdb(text, file_.name(), model.line, models_.size() == 1 ? &notes : nullptr);
  return conformation(assemble(parse_with_gemmi(text, file_.name(), false), file_.name(), options_), structure_,
                      may_have_more_, file_.name() + ": model " + std::to_string(model.number));
}

std::vector<Vec3> PdbModels::frame(std::size_t k) const {
  const Model& model = models_[k];
  const std::string own = text(model);
  std::vector<Vec3> all;
  all.reserve(records_.size() / identity_bytes);
  std::string record;
  std::size_t line_number = model.line;
  bool same = !own.empty(), ended = false;
  for_lines(own, [&](std::string_view line) {
    ++line_number;
    ended = is_endmdl(line) || is_end(line);
    if (!same || !is_atom_record(line)) return;
    record.clear();
    append_identity(record, line);
    const std::size_t at = all.size() * identity_bytes;
    same = at < records_.size() && records_.compare(at, identity_bytes, record) == 0;
    all.push_back(read_pdb_coordinates(line, file_.name(), line_number));
  });
  // The model is cut short or has other records: parse it.
  if (!same || !ended || all.empty() || all.size() * identity_bytes != records_.size())
    return parsed(own, model).positions;
  std::vector<Vec3> positions;
  positions.reserve(kept_.size());
  for (const std::uint32_t i : kept_) positions.push_back(all[i]);
  return positions;
}

}  // namespace hinge::molecular
