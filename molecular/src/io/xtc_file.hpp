// SPDX-License-Identifier: BSD-3-Clause
// XtcFile: compressed trajectories of GROMACS.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "io/binary_file.hpp"

namespace hinge::molecular {

/// Big-endian. Frames have lengths of their own, so their places are looked up when the file is opened, by their
/// headers alone.
class XtcFile {
 public:
  explicit XtcFile(BinaryFile file);

  static bool is_one(const BinaryFile& file);

  /// Frames that begin in the file; none is looked for behind a damaged one.
  std::size_t size() const noexcept { return frames_at_.size(); }
  std::size_t atom_count() const noexcept { return atoms_; }

  /// Angstrom: the whole steps of its grid, to the nearest doubles. LoadError: damaged, or cut short.
  std::vector<Vec3> frame(std::size_t k) const;

 private:
  /// Numbers before a frame's coordinates, and where those are.
  struct Head {
    std::int32_t magic = 0;
    std::int32_t atoms = 0;
    std::uint64_t data_at = 0;  ///< byte
    std::int64_t data_size = 0;
    std::vector<char> bytes;
  };
  Head head(std::uint64_t offset) const;

  BinaryFile file_;
  std::size_t atoms_ = 0;
  std::vector<std::uint64_t> frames_at_;  ///< bytes
};

}  // namespace hinge::molecular
