// SPDX-License-Identifier: BSD-3-Clause
// FrameIndex: keeps the places of a file's frames in a second file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "io/binary_file.hpp"

namespace hinge::molecular {

/// The second file lies in a folder, under a name made from path, size and time of the first file, so that it is never
/// that of another one. It only saves a search: files that cannot be read or written are ignored.
class FrameIndex {
 public:
  /// folder: empty, or a folder that exists.
  FrameIndex(const std::filesystem::path& folder, const BinaryFile& of);

  /// Returns the offsets, or nothing if there is no index.
  std::vector<std::uint64_t> read() const;
  /// Writes the index, completely or not at all.
  void write(const std::vector<std::uint64_t>& offsets) const;

 private:
  std::filesystem::path path_;  // empty: none is kept
  std::uint64_t size_;          // bytes of the first file
};

}  // namespace hinge::molecular
