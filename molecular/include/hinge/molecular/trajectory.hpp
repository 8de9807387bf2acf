// SPDX-License-Identifier: BSD-3-Clause
// Trajectory: the conformations of a molecule in a file, read one at a time in bounded memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// A DCD, XTC, NumPy (frames x atoms x 3, angstrom), PDB, mmCIF or PQR file, gzipped or not; the content decides, for
/// PQR the name. Frames of the first three have as many atoms as the first model of the molecule's file has atom
/// records, or as the molecule has atoms, in the same order; PDB and mmCIF models name their atoms. mmCIF and gzipped
/// files are held in memory; other files only one frame and the offsets of all. Const members may be called by many
/// threads at once.
class HINGE_API Trajectory {
 public:
  /// Opens a file. The molecule must outlive this object. may_have_more: PDB and mmCIF models may have further atoms,
  /// which are dropped. Throws LoadError if the file cannot be read or its frames belong to another molecule. DCD and
  /// NumPy files may hold 0 frames; notes() says so.
  Trajectory(const std::filesystem::path& path, const Structure& molecule, const ReadOptions& options = {},
             bool may_have_more = false);
  /// Uses the molecule's own models as frames. The molecule must outlive this object.
  explicit Trajectory(const Structure& molecule);
  /// Takes the open file of `other`, which may then only be destroyed or assigned to.
  Trajectory(Trajectory&& other) noexcept;
  /// The same for an existing object, whose own file is closed.
  Trajectory& operator=(Trajectory&& other) noexcept;
  ~Trajectory();

  /// Number of frames that begin in the file; the last may be cut short.
  std::size_t size() const noexcept;
  /// Number of atoms of each frame.
  std::size_t atom_count() const noexcept;
  /// True if the file stores coordinates as 32-bit floats that are read exactly (DCD, NumPy float32; not XTC).
  bool is_single() const noexcept;
  /// Returns the model number of frame k in its file, or k if the format has no numbers.
  int number(std::size_t k) const noexcept;
  /// Warnings about the file, one sentence each.
  const std::vector<std::string>& notes() const noexcept { return notes_; }

  /// Returns the positions of frame k < size(), angstrom, atom_count() of them. Throws LoadError, with the file, frame
  /// and atom, if the frame is damaged, cut short or not finite. Throws OtherAtoms (a LoadError) if a PDB or mmCIF
  /// model is not a conformation of the molecule.
  std::vector<Vec3> frame(std::size_t k) const;
  /// Reduces a frame to the molecule's atoms, in the molecule's order. frame: atom_count() positions.
  std::vector<Vec3> kept(std::vector<Vec3> frame) const;

 private:
  struct Format;
  void choose_atoms();
  void check_unit();  // adds a note if bond lengths of a NumPy file look like nanometres

  std::string path_;
  const Structure* molecule_;
  std::unique_ptr<const Format> format_;
  bool all_kept_ = true;
  std::vector<std::string> notes_;
};

}  // namespace hinge::molecular
