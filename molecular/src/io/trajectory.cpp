// SPDX-License-Identifier: BSD-3-Clause
// Trajectory: selects the reader of a file by its content.
#include "hinge/molecular/trajectory.hpp"

#include <concepts>
#include <utility>
#include <variant>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "io/binary_file.hpp"
#include "io/dcd_file.hpp"
#include "io/npy_file.hpp"
#include "io/pdb_models.hpp"
#include "io/read_file.hpp"
#include "io/xtc_file.hpp"

namespace hinge::molecular {

struct Trajectory::Format {
  /// Models in memory.
  struct Models {
    std::vector<std::vector<Vec3>> own;  ///< empty: the molecule's own models
    std::vector<int> numbers;
    std::vector<std::string> refusals;  ///< per model: why it is not a frame, if it has other atoms; otherwise empty
    const Structure& molecule;

    std::size_t size() const noexcept { return numbers.size(); }
    int number(std::size_t k) const noexcept { return numbers[k]; }
    std::vector<Vec3> frame(std::size_t k) const {
      if (own.empty()) return molecule.models[k];
      if (!refusals[k].empty()) throw OtherAtoms(refusals[k]);
      return own[k];
    }
  };
  template <class File>
  static constexpr bool names_atoms = std::same_as<File, Models> || std::same_as<File, PdbModels>;

  std::variant<DcdFile, XtcFile, NpyFile, PdbModels, Models> file;

  static Format open(const std::filesystem::path& path, const Structure& molecule, const ReadOptions& options,
                     bool may_have_more);
  /// Reads the models of an mmCIF or PQR file.
  static Models models(const std::filesystem::path& path, const Structure& molecule, const ReadOptions& options,
                       bool may_have_more);
};

Trajectory::Format::Models Trajectory::Format::models(const std::filesystem::path& path, const Structure& molecule,
                                                      const ReadOptions& options, bool may_have_more) {
  Models all{{}, {}, {}, molecule};
  for (const Structure& other : assemble_each(read_raw(read_bytes(path), path), path.string(), options)) {
    const int number = other.model_numbers[0];
    all.numbers.push_back(number);
    all.own.emplace_back();
    all.refusals.emplace_back();
    try {
      all.own.back() =
          conformation(other, molecule, may_have_more, path.string() + ": model " + std::to_string(number)).positions;
    } catch (const OtherAtoms& error) {
      if (all.own.size() == 1) throw;
      all.refusals.back() = error.what();
    }
  }
  return all;
}

Trajectory::Format Trajectory::Format::open(const std::filesystem::path& path, const Structure& molecule,
                                            const ReadOptions& options, bool may_have_more) {
  BinaryFile file(path);
  if (DcdFile::is_one(file)) return {DcdFile(std::move(file))};
  if (XtcFile::is_one(file)) return {XtcFile(std::move(file), options.index_folder)};
  if (NpyFile::is_one(file)) return {NpyFile(std::move(file))};
  std::string text(std::size_t{1} << 16, '\0');
  text.resize(file.read(0, text));
  if (looks_like_cif(text) || is_pqr(path)) return {models(path, molecule, options, may_have_more)};
  return {PdbModels(std::move(file), molecule, options, may_have_more)};
}

Trajectory::Trajectory(Trajectory&& other) noexcept = default;
Trajectory& Trajectory::operator=(Trajectory&& other) noexcept = default;
Trajectory::~Trajectory() = default;

Trajectory::Trajectory(const std::filesystem::path& path, const Structure& molecule, const ReadOptions& options,
                       bool may_have_more)
    : path_(path.string()),
      molecule_(&molecule),
      format_(std::make_unique<const Format>(Format::open(path, molecule, options, may_have_more))) {
  choose_atoms();
  if (const auto* dcd = std::get_if<DcdFile>(&format_->file)) notes_ = dcd->notes();
  if (size() == 0)
    notes_.push_back(path_ + ": holds 0 frames");
  else if (std::holds_alternative<NpyFile>(format_->file))
    check_unit();
}

Trajectory::Trajectory(const Structure& molecule)
    : path_(molecule.name),
      molecule_(&molecule),
      format_(std::make_unique<const Format>(Format{Format::Models{{}, molecule.model_numbers, {}, molecule}})) {}

void Trajectory::choose_atoms() {
  const std::size_t atoms = atom_count(), records = molecule_->atom_records, own = molecule_->atoms.size();
  if (atoms != own && (records == 0 || atoms != records)) {
    std::string expected = std::to_string(records) + " (all atoms of the molecule's file)";
    if (records != own) expected += " or " + std::to_string(own) + " (the atoms read from it)";
    throw LoadError(path_ + ": frames of " + std::to_string(atoms) + " atoms, expected " + expected);
  }
  all_kept_ = atoms == own;
}

void Trajectory::check_unit() {
  std::vector<Vec3> positions;
  try {
    positions = kept(frame(0));
  } catch (const LoadError&) {
    return;  // frame(0) reports the error
  }
  double sum = 0.0;
  for (const Bond& bond : molecule_->bonds) sum += norm(Vec3(positions[bond.first] - positions[bond.second]));
  const double mean = sum / static_cast<double>(molecule_->bonds.size());
  // Bonds of organic molecules measure 1 to 2 angstrom: 0.1 to 0.2 if the unit is nanometres.
  if (!molecule_->bonds.empty() && mean < 0.3)
    notes_.push_back(path_ + ": the mean bond length in its first frame is " + number_text(mean) +
                     ", as in nanometres; the file is read as angstrom");
}

std::size_t Trajectory::size() const noexcept {
  return std::visit([](const auto& file) { return file.size(); }, format_->file);
}

std::size_t Trajectory::atom_count() const noexcept {
  return std::visit(
      [this]<class File>(const File& file) {
        if constexpr (Format::names_atoms<File>)
          return molecule_->atoms.size();
        else
          return file.atom_count();
      },
      format_->file);
}

bool Trajectory::is_single() const noexcept {
  if (const auto* npy = std::get_if<NpyFile>(&format_->file)) return npy->is_single();
  return std::holds_alternative<DcdFile>(format_->file);
}

int Trajectory::number(std::size_t k) const noexcept {
  return std::visit(
      [k]<class File>(const File& file) {
        if constexpr (Format::names_atoms<File>)
          return file.number(k);
        else
          return static_cast<int>(k);
      },
      format_->file);
}

std::vector<Vec3> Trajectory::frame(std::size_t k) const {
  std::vector<Vec3> positions = std::visit([k](const auto& file) { return file.frame(k); }, format_->file);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (is_length(positions[i])) continue;
    std::string atom = "atom " + std::to_string(i) + " (from 0";
    for (std::uint32_t own = 0; own < molecule_->atoms.size(); ++own)
      if ((all_kept_ ? own : molecule_->atoms[own].record) == i) atom += ", " + label(*molecule_, own);
    Eigen::Index axis = 0;
    while (is_length(positions[i][axis])) ++axis;
    throw LoadError(path_ + ": frame " + std::to_string(k) + ": " + atom + "): " + "xyz"[axis] + " is " +
                    number_text(positions[i][axis]) + ", expected a finite number");
  }
  return positions;
}

std::vector<Vec3> Trajectory::kept(std::vector<Vec3> frame) const {
  if (all_kept_) return frame;
  std::vector<Vec3> positions;
  positions.reserve(molecule_->atoms.size());
  for (const Atom& atom : molecule_->atoms) positions.push_back(frame[atom.record]);
  return positions;
}

}  // namespace hinge::molecular
