// SPDX-License-Identifier: BSD-3-Clause
// Trajectory: the conformations of a molecule that a file holds, one at a time, in bounded memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// DCD, XTC, NumPy (frames x atoms x 3, angstrom), PDB or mmCIF, gzipped or not, told by content. Frames of the first
/// three have as many atoms as the first model of the molecule's file has atom records, in the same order, or as the
/// molecule itself; models name their atoms. Of mmCIF and gzipped files the whole text is in memory, else a frame at a
/// time and where frames begin. Frames may be read by many threads at once.
class Trajectory {
 public:
  /// The molecule must outlive it. LoadError: cannot be read, or frames of another molecule. DCD and NumPy
  /// files may hold 0 frames, which notes() says.
  /// may_have_more: models of PDB and mmCIF files may have other atoms too, which are left out.
  Trajectory(const std::filesystem::path& path, const Structure& molecule, const ReadOptions& options = {},
             bool may_have_more = false);
  /// The molecule's own models.
  explicit Trajectory(const Structure& molecule);
  Trajectory(Trajectory&& other) noexcept;
  Trajectory& operator=(Trajectory&& other) noexcept;
  ~Trajectory();

  /// Frames that begin in the file; the last may be cut short.
  std::size_t size() const noexcept;
  /// Of each frame.
  std::size_t atom_count() const noexcept;
  /// Are coordinates floats of 32 bits?
  bool is_single() const noexcept;
  /// The model's number in its file; k where frames have none.
  int number(std::size_t k) const noexcept;
  /// What is odd about the file, one sentence each.
  const std::vector<std::string>& notes() const noexcept { return notes_; }

  /// Frame k < size(): every atom, as the file has them, angstrom. LoadError names the file, the frame and the atom:
  /// damaged, cut short, not finite. OtherAtoms (a LoadError): a model that is no conformation of the molecule.
  std::vector<Vec3> frame(std::size_t k) const;
  /// Those of a frame that are the molecule's atoms, in its order.
  std::vector<Vec3> kept(std::vector<Vec3> frame) const;

 private:
  struct Format;
  void choose_atoms();
  void check_unit();  // of files that do not say it

  std::string path_;
  const Structure* molecule_;
  std::unique_ptr<const Format> format_;
  bool all_kept_ = true;
  std::vector<std::string> notes_;
};

}  // namespace hinge::molecular
