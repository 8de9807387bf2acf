// SPDX-License-Identifier: BSD-3-Clause
// UnpackedFile: the bytes of a file, gunzipped where it is gzipped.
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

/// A gzipped file is one or more members and nothing else, but for zeros that fill up the last block of a tape. zlib's
/// own gzread takes whatever else stands behind a member for the end of the file, and drops it.
class UnpackedFile {
 public:
  /// LoadError as InputFile's.
  explicit UnpackedFile(const std::filesystem::path& path);
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;
  ~UnpackedFile();

  /// The next bytes; 0: the file is at its end. LoadError naming file and byte: damaged, cut short, or followed by what
  /// is no gzip member.
  std::size_t read(std::span<char> to);
  /// Bytes of the file that were taken so far.
  std::uint64_t packed() const noexcept { return file_.position() - stream_.avail_in; }

 private:
  /// Reads on when nothing is left; false: the file is at its end.
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
