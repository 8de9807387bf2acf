// SPDX-License-Identifier: BSD-3-Clause
// Viewer scripts: a conformation, its clashes, and the file of --out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/molecular/write_structure.hpp"
#include "hinge/policy/collector.hpp"
#include "options.hpp"

namespace biocd {

/// Returns all files that --view may write: the script, and the structure as PDB or mmCIF.
std::vector<std::filesystem::path> view_files(const Options& options);

/// Chooses the conformation with the most colliding pairs, the first of several; with mode any the first that collides.
class ViewChoice {
 public:
  /// Takes conformation k into account.
  void offer(std::size_t k, const hinge::molecular::Verdict& verdict);
  /// Returns the chosen conformation; nothing if none was offered.
  const std::optional<std::size_t>& best() const { return best_; }

 private:
  std::optional<std::size_t> best_;
  std::size_t clashes_ = 0;
};

/// A conformation to show.
struct Shown {
  std::string name;                              ///< for messages, such as "model 3"
  std::vector<hinge::Vec3> positions;            ///< angstrom, one per atom
  std::vector<hinge::molecular::Contact> pairs;  ///< pairs to mark
};

/// Writes the files of --view and says so: on standard output below a table, otherwise on standard error. with_out:
/// the script opens the file of --out too. Throws LoadError if a file cannot be written.
void write_view(const Options& options, const Job& job, const Shown& shown, bool with_out);

/// Writes one conformation to stem.pdb, or to stem.cif if the PDB format cannot hold the structure. Returns the name of
/// the file without its folder. Throws LoadError if it cannot be written.
std::string write_shown_structure(const hinge::molecular::Structure& structure, std::span<const hinge::Vec3> positions,
                                  const std::filesystem::path& stem);

/// Writes the script stem.cxc (ChimeraX) or stem.pml (PyMOL). Throws LoadError if it cannot be written.
void write_viewer_script(Viewer viewer, const hinge::molecular::Structure& structure, std::span<const hinge::Hit> pairs,
                         const std::filesystem::path& stem, const hinge::molecular::ViewedFiles& files);

}  // namespace biocd
