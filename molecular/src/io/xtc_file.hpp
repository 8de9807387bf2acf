// SPDX-License-Identifier: BSD-3-Clause
// XtcFile: reads compressed trajectories of GROMACS.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "io/binary_file.hpp"

namespace hinge::molecular {

/// Big-endian. Frames differ in length, so the constructor finds their offsets from the headers.
class XtcFile {
 public:
  /// index_folder: where the offsets are kept for other processes; empty: nowhere. Throws LoadError if the first header
  /// is damaged.
  explicit XtcFile(BinaryFile file, const std::filesystem::path& index_folder = {});

  /// True if the file starts as an XTC file.
  static bool is_one(const BinaryFile& file);

  /// Frames that begin in the file; the search stops at a damaged header.
  std::size_t size() const noexcept { return frames_at_.size(); }
  /// Atoms per frame.
  std::size_t atom_count() const noexcept { return atoms_; }

  /// Returns the positions of frame k, angstrom: integer grid steps, rounded to the nearest doubles. Throws LoadError
  /// if it is damaged or cut short.
  std::vector<Vec3> frame(std::size_t k) const;

 private:
  /// Header of a frame, and the location of its coordinates.
  struct Head {
    std::int32_t magic = 0;
    std::int32_t atoms = 0;
    std::uint64_t data_at = 0;   ///< byte offset
    std::int64_t data_size = 0;  ///< bytes
    std::vector<char> bytes;
  };
  Head head(std::uint64_t offset) const;
  void find_frames();

  BinaryFile file_;
  std::size_t atoms_ = 0;
  std::vector<std::uint64_t> frames_at_;  ///< byte offsets
};

}  // namespace hinge::molecular
