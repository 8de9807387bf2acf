// SPDX-License-Identifier: BSD-3-Clause
// ConformationFile: writes the conformations that --out and --filter select.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <span>
#include <string>

#include "hinge/core/error.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/write_structure.hpp"
#include "hinge/molecular/write_trajectory.hpp"
#include "hinge_tools/complete_file.hpp"
#include "options.hpp"

namespace biocd {

/// Returns how many results may wait for their turn: together about 64 Ki atoms, so that memory does not grow with the
/// molecule.
inline std::size_t results_at_once(std::size_t atoms) {
  return std::clamp<std::size_t>((std::size_t{1} << 16) / std::max<std::size_t>(atoms, 1), 1, 256);
}

/// Returns the format of --out by its extension; pdb for an empty path. Throws ModelError for another extension.
inline hinge::molecular::TrajectoryFormat conformation_format(const std::string& path) {
  const auto format = hinge::molecular::trajectory_format(path);
  if (!path.empty() && !format)
    throw hinge::ModelError("--out " + path + ": expected a file name with " + hinge::molecular::trajectory_extensions);
  return format.value_or(hinge::molecular::TrajectoryFormat::pdb);
}

/// Output file of --out, written completely or not at all. With --filter free it takes only conformations without
/// collision. Does nothing if --out is not given. One thread only.
class ConformationFile {
 public:
  /// frame_atoms: atoms per frame of the input; DCD, XTC and NumPy files take whole frames, PDB and mmCIF files the
  /// atoms of the molecule. single: write 32-bit floats. Throws ModelError for another extension, or a molecule that
  /// does not fit PDB; LoadError if the file cannot be written.
  ConformationFile(const Options& options, const hinge::molecular::Structure& molecule, std::size_t frame_atoms,
                   bool single)
      : only_free_(options.only_free),
        format_(conformation_format(options.out)),
        path_(options.out),
        file_((check(molecule), options.out)) {
    if (!wanted()) return;
    if (!file_.is_regular() && counts_frames(format_))
      throw hinge::ModelError("--out " + options.out +
                              ": is a device or pipe, expected a regular file: DCD and NumPy files begin with their "
                              "number of frames");
    writer_.emplace(file_.stream(), format_, molecule, wants_whole_frames() ? frame_atoms : molecule.atoms.size(),
                    single);
  }

  /// Returns true if --out is given.
  bool wanted() const { return file_.wanted(); }
  /// Returns true if add() writes a conformation with this verdict.
  bool takes(bool collides) const { return wanted() && !(only_free_ && collides); }
  /// Returns true if add() needs all atoms of the frame, not only the atoms of the molecule.
  bool wants_whole_frames() const { return wanted() && !names_atoms(format_); }
  /// Returns the number of conformations written so far.
  std::size_t size() const { return writer_ ? writer_->size() : 0; }
  /// Writes one conformation if takes(collides). positions: angstrom, one per atom. number: of its model.
  void add(std::span<const hinge::Vec3> positions, int number, bool collides) {
    if (!takes(collides)) return;
    writer_->add(positions, number);
    file_.check();
  }
  /// Completes the file. Without conformations, DCD and NumPy files hold 0 frames; the other files cannot be empty, so
  /// none is written and an existing file stays unchanged.
  void finish() {
    if (!wanted()) return;
    const bool is_file = size() > 0 || counts_frames(format_);
    if (size() == 0)
      fmt::print(stderr, "note: --out {}: no conformation{}: {}\n", path_, only_free_ ? " is free" : " to write",
                 is_file ? "the file holds 0 frames" : "no file is written, the format needs frames");
    if (!is_file) return;
    writer_->finish();
    file_.finish();
  }

 private:
  void check(const hinge::molecular::Structure& molecule) const {
    if (!path_.empty() && format_ == hinge::molecular::TrajectoryFormat::pdb) check_fits_pdb(molecule);
  }

  bool only_free_;
  hinge::molecular::TrajectoryFormat format_;
  std::string path_;
  hinge::tool::CompleteFile file_;
  std::optional<hinge::molecular::TrajectoryWriter> writer_;
};

}  // namespace biocd
