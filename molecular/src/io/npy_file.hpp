// SPDX-License-Identifier: BSD-3-Clause
// NpyFile: coordinates in a NumPy array of frames x atoms x 3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "io/binary_file.hpp"

namespace hinge::molecular {

/// float32 or float64 of either byte order, angstrom; atoms x 3 is one frame. (NEP 1, numpy.lib.format.) In Fortran
/// order a frame lies scattered over the file and takes a read for each of its numbers.
class NpyFile {
 public:
  /// LoadError: another type or shape; no frame; bytes behind the last one.
  explicit NpyFile(BinaryFile file);

  static bool is_one(const BinaryFile& file);

  /// Frames that begin in the file, as many as the header says where it is whole.
  std::size_t size() const noexcept { return frames_; }
  std::size_t atom_count() const noexcept { return atoms_; }
  bool is_single() const noexcept { return width_ == 4; }

  /// Angstrom. LoadError: cut short.
  std::vector<Vec3> frame(std::size_t k) const;

 private:
  BinaryFile file_;
  bool reversed_ = false;
  bool fortran_ = false;
  std::size_t width_ = 8;
  std::size_t frames_ = 0;
  std::size_t atoms_ = 0;
  std::uint64_t data_at_ = 0;
};

}  // namespace hinge::molecular
