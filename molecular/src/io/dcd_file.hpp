// SPDX-License-Identifier: BSD-3-Clause
// DcdFile: reads trajectories of CHARMM, NAMD and X-PLOR.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "io/binary_file.hpp"

namespace hinge::molecular {

/// Fortran records of 32-bit numbers in either byte order, with record markers of four or eight bytes. A frame is an
/// optional unit cell, then x, y and z of its atoms as floats (angstrom), and a fourth coordinate in CHARMM's 4D
/// dynamics. Fixed atoms are stored in the first frame only (CHARMM, dynio.src; VMD, dcdplugin.c).
class DcdFile {
 public:
  /// Throws LoadError if the header is damaged, or claims frames in a file without any.
  explicit DcdFile(BinaryFile file);

  /// True if the file starts as a DCD file.
  static bool is_one(const BinaryFile& file);

  /// Frames that begin in the file, whatever its header claims.
  std::size_t size() const noexcept { return frames_; }
  /// Atoms per frame.
  std::size_t atom_count() const noexcept { return atoms_; }
  /// Warnings about the file.
  const std::vector<std::string>& notes() const noexcept { return notes_; }

  /// Returns the positions of frame k, angstrom. Throws LoadError if it is damaged or cut short.
  std::vector<Vec3> frame(std::size_t k) const;

 private:
  /// Returns a record's length without its two markers; `next` becomes the offset of the next record.
  std::uint64_t record(std::uint64_t offset, std::uint64_t& next, const std::string& what) const;
  std::uint64_t marker(const char* bytes) const noexcept;
  std::int32_t integer(const std::vector<char>& bytes, std::size_t k) const noexcept {
    return number_at<std::int32_t>(bytes.data() + 4 * k, reversed_);
  }
  std::uint64_t frame_bytes(std::uint64_t atoms) const noexcept;
  void read_axes(std::size_t k, std::uint64_t offset, std::vector<Vec3>& positions, bool all) const;

  BinaryFile file_;
  bool reversed_ = false;        ///< numbers are not in this machine's byte order
  std::size_t marker_size_ = 4;  ///< bytes
  bool has_cell_ = false;
  bool has_fourth_ = false;  ///< a fourth coordinate per atom
  std::size_t atoms_ = 0;
  std::vector<std::uint32_t> moving_;  ///< atoms stored in frames after the first; empty: all atoms
  std::vector<Vec3> first_;            ///< the first frame, if atoms are fixed
  std::uint64_t frames_at_ = 0;        ///< byte offset
  std::size_t frames_ = 0;
  std::vector<std::string> notes_;
};

}  // namespace hinge::molecular
