// SPDX-License-Identifier: BSD-3-Clause
// BinaryFile: reads bytes at any offset from any thread, and numbers of either byte order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hinge::molecular {

/// A file that is open for the object's lifetime; a gzipped file is unpacked into memory. Const members may be called
/// by many threads at once.
class BinaryFile {
 public:
  /// Throws LoadError if the file cannot be opened, is a directory, pipe or device, is empty, or is gzipped and
  /// damaged.
  explicit BinaryFile(const std::filesystem::path& path);
  BinaryFile(BinaryFile&& other) noexcept;
  BinaryFile& operator=(BinaryFile&& other) = delete;
  ~BinaryFile();

  /// The path given to the constructor.
  const std::string& name() const noexcept { return name_; }
  /// Number of bytes when it was opened; for a gzipped file, of the unpacked data.
  std::uint64_t size() const noexcept { return size_; }

  /// Reads the bytes from `offset` on and returns their number, which is less than to.size() only at the end of the
  /// file. Throws LoadError if they cannot be read.
  std::size_t read(std::uint64_t offset, std::span<char> to) const;
  /// Reads all requested bytes, or throws LoadError with the end of the file; `what` names the data for the message.
  void read_all(std::uint64_t offset, std::span<char> to, const std::string& what) const;
  std::vector<char> read_all(std::uint64_t offset, std::size_t count, const std::string& what) const;

 private:
  std::string name_;
  std::uint64_t size_ = 0;
  int descriptor_ = -1;   ///< of a plain file; -1: unpacked_ holds the data
  std::string unpacked_;  ///< data of a gzipped file
};

/// Converts bytes to a number; reversed: the other byte order than this machine's.
template <class Number>
Number number_at(const char* bytes, bool reversed) noexcept {
  std::array<char, sizeof(Number)> own{};
  std::memcpy(own.data(), bytes, sizeof(Number));
  if (reversed) std::reverse(own.begin(), own.end());
  return std::bit_cast<Number>(own);
}

}  // namespace hinge::molecular
