// SPDX-License-Identifier: BSD-3-Clause
// UnpackedFile: the bytes of a file, gunzipped if it is gzipped.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hinge_tools/input_file.hpp"

namespace hinge::molecular {

/// True if the first two bytes of a file are those of a gzip member.
inline bool starts_gzip(char first, char second) noexcept { return first == '\x1f' && second == '\x8b'; }

/// A gzipped file consists of one or more members; only zeros, which pad the last block of a tape, may follow. zlib's
/// gzread would stop at any other data after a member and drop them silently.
class UnpackedFile {
 public:
  /// Throws LoadError as tool::InputFile does, and for formats that are not read (bzip2, xz, zstd, zip, BinaryCIF).
  explicit UnpackedFile(const std::filesystem::path& path);
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;
  ~UnpackedFile();

  /// Reads the next bytes and returns their number; 0 at the end of the file. Throws LoadError, with file and byte, if
  /// it is damaged, cut short, or followed by data that are not a gzip member.
  std::size_t read(std::span<char> to);
  /// Number of bytes of the file consumed so far.
  std::uint64_t packed() const noexcept { return file_.position() - stream_.avail_in; }

 private:
  /// Reads more bytes if none are left; false at the end of the file.
  bool fill();
  std::size_t unpack(std::span<char> to);
  [[noreturn]] void refuse(const std::string& what) const;

  tool::InputFile file_;
  std::vector<char> packed_;
  z_stream stream_{};
  bool is_gzipped_ = false;
  bool in_member_ = false;
  std::uint64_t members_ = 0;
};

}  // namespace hinge::molecular
