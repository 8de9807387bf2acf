// SPDX-License-Identifier: BSD-3-Clause
// BinaryFile: bytes of a file at any place, from any thread, and numbers of either byte order in them.
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

/// Open while the object lives; one that is gzipped is unpacked into memory. Reads are stateless, so that threads share
/// one.
class BinaryFile {
 public:
  /// LoadError: cannot be opened, is a directory, is empty, or gzipped and damaged.
  explicit BinaryFile(const std::filesystem::path& path);
  BinaryFile(BinaryFile&& other) noexcept;
  BinaryFile& operator=(BinaryFile&& other) = delete;
  ~BinaryFile();

  const std::string& name() const noexcept { return name_; }
  /// Bytes, when it was opened; of a gzipped file those that are packed in it.
  std::uint64_t size() const noexcept { return size_; }

  /// The bytes from `offset` on; fewer than asked for only where the file ends. LoadError: cannot be read.
  std::size_t read(std::uint64_t offset, std::span<char> to) const;
  /// All of them, else a LoadError that says where the file ends; `what` is being read.
  void read_all(std::uint64_t offset, std::span<char> to, const std::string& what) const;
  std::vector<char> read_all(std::uint64_t offset, std::size_t count, const std::string& what) const;

 private:
  std::string name_;
  std::uint64_t size_ = 0;
  int descriptor_ = -1;   ///< of a plain file
  std::string unpacked_;  ///< of a gzipped one
};

/// A number from its bytes, in their order or reversed.
template <class Number>
Number number_at(const char* bytes, bool reversed) noexcept {
  std::array<char, sizeof(Number)> own{};
  std::memcpy(own.data(), bytes, sizeof(Number));
  if (reversed) std::reverse(own.begin(), own.end());
  return std::bit_cast<Number>(own);
}

}  // namespace hinge::molecular
