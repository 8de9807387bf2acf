// SPDX-License-Identifier: BSD-3-Clause
// ConformationFile: what --out and --filter ask for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

#include "hinge/core/error.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/write_trajectory.hpp"
#include "hinge/tool/complete_file.hpp"
#include "options.hpp"

namespace biocd {

/// How many results may wait at once for their turn: together about 64 Ki atoms, so that memory does not grow with the
/// molecule.
inline std::size_t results_at_once(std::size_t atoms) {
  return std::clamp<std::size_t>((std::size_t{1} << 16) / std::max<std::size_t>(atoms, 1), 1, 256);
}

class ConformationFile {
 public:
  /// frame_atoms: of whole frames, which DCD and NumPy files take; PDB files take the molecule's atoms. ModelError:
  /// another extension. LoadError: cannot be written.
  ConformationFile(const Options& options, const hinge::molecular::Structure& molecule, std::size_t frame_atoms,
                   bool single)
      : only_free_(options.only_free), format_(format_of(options.out)), file_(options.out) {
    if (!wanted()) return;
    if (!file_.is_regular() && wants_whole_frames())
      throw hinge::ModelError("--out " + options.out +
                              ": is a device or pipe, expected a regular file: DCD and NumPy files begin with their "
                              "number of frames");
    writer_.emplace(file_.stream(), format_, molecule, wants_whole_frames() ? frame_atoms : molecule.atoms.size(),
                    single);
  }

  bool wanted() const { return file_.wanted(); }
  /// Does it take this one?
  bool takes(bool collides) const { return wanted() && !(only_free_ && collides); }
  bool wants_whole_frames() const { return wanted() && format_ != hinge::molecular::TrajectoryFormat::pdb; }
  void add(std::span<const hinge::Vec3> positions, int number, bool collides) {
    if (!takes(collides)) return;
    writer_->add(positions, number);
    file_.check();
  }
  void finish() {
    if (writer_) writer_->finish();
    file_.finish();
  }

 private:
  static hinge::molecular::TrajectoryFormat format_of(const std::string& path) {
    const auto format = hinge::molecular::trajectory_format(path);
    if (!path.empty() && !format) throw hinge::ModelError("--out " + path + ": expected .pdb, .dcd or .npy");
    return format.value_or(hinge::molecular::TrajectoryFormat::pdb);
  }

  bool only_free_;
  hinge::molecular::TrajectoryFormat format_;
  hinge::tool::CompleteFile file_;
  std::optional<hinge::molecular::TrajectoryWriter> writer_;
};

}  // namespace biocd
