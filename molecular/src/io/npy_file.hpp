// SPDX-License-Identifier: BSD-3-Clause
// NpyFile: reads coordinates from a NumPy array of frames x atoms x 3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "io/binary_file.hpp"

namespace hinge::molecular {

/// float32 or float64 of either byte order, angstrom; a shape of atoms x 3 is one frame (NEP 1, numpy.lib.format). In
/// Fortran order, the numbers of a frame are scattered over the file: each takes one read.
class NpyFile {
 public:
  /// Throws LoadError for another type or shape, and for bytes after the last frame.
  explicit NpyFile(BinaryFile file);

  /// True if the file starts as a NumPy array.
  static bool is_one(const BinaryFile& file);

  /// Frames that begin in the file; the header's number if the file is complete.
  std::size_t size() const noexcept { return frames_; }
  /// Atoms per frame.
  std::size_t atom_count() const noexcept { return atoms_; }
  /// True for float32.
  bool is_single() const noexcept { return width_ == 4; }

  /// Returns the positions of frame k, angstrom. Throws LoadError if it is cut short.
  std::vector<Vec3> frame(std::size_t k) const;

 private:
  BinaryFile file_;
  bool reversed_ = false;  ///< numbers are not in this machine's byte order
  bool fortran_ = false;
  std::size_t width_ = 8;  ///< bytes per number
  std::size_t frames_ = 0;
  std::size_t atoms_ = 0;
  std::uint64_t data_at_ = 0;  ///< byte
};

}  // namespace hinge::molecular
