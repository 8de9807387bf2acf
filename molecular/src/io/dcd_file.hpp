// SPDX-License-Identifier: BSD-3-Clause
// DcdFile: trajectories of CHARMM, NAMD and X-PLOR.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "io/binary_file.hpp"

namespace hinge::molecular {

/// Fortran records of 32-bit numbers, in either byte order, record lengths of four or eight bytes. A frame is an
/// optional unit cell, the x, the y and the z of its atoms as floats (angstrom), and in CHARMM's 4D dynamics a fourth
/// coordinate. Atoms that are held fixed are in the first frame only. (CHARMM, dynio.src; VMD, dcdplugin.c.)
class DcdFile {
 public:
  /// LoadError: the header is damaged, or there is no frame.
  explicit DcdFile(BinaryFile file);

  static bool is_one(const BinaryFile& file);

  /// Frames that begin in the file, whatever its header says.
  std::size_t size() const noexcept { return frames_; }
  std::size_t atom_count() const noexcept { return atoms_; }
  const std::vector<std::string>& notes() const noexcept { return notes_; }

  /// Angstrom. LoadError: damaged, or cut short.
  std::vector<Vec3> frame(std::size_t k) const;

 private:
  /// A record's length without its two markers; `next` becomes where the next one starts.
  std::uint64_t record(std::uint64_t offset, std::uint64_t& next, const std::string& what) const;
  std::uint64_t marker(const char* bytes) const noexcept;
  std::int32_t integer(const std::vector<char>& bytes, std::size_t k) const noexcept {
    return number_at<std::int32_t>(bytes.data() + 4 * k, reversed_);
  }
  std::uint64_t frame_bytes(std::uint64_t atoms) const noexcept;
  void read_axes(std::size_t k, std::uint64_t offset, std::vector<Vec3>& positions, bool all) const;

  BinaryFile file_;
  bool reversed_ = false;
  std::size_t marker_size_ = 4;
  bool has_cell_ = false;
  bool has_fourth_ = false;
  std::size_t atoms_ = 0;
  std::vector<std::uint32_t> moving_;  ///< atoms of every frame but the first; empty: all of them
  std::vector<Vec3> first_;            ///< the first frame, where atoms are fixed
  std::uint64_t frames_at_ = 0;        ///< byte
  std::size_t frames_ = 0;
  std::vector<std::string> notes_;
};

}  // namespace hinge::molecular
