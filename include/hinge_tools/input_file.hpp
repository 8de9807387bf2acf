// SPDX-License-Identifier: BSD-3-Clause
// InputFile: reads the bytes of a file or pipe in sequence.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>

#include "hinge/core/error.hpp"

namespace hinge::tool {

/// Maximum number of bytes from a pipe: its length is unknown in advance, and some pipes never end.
inline constexpr std::uint64_t most_piped = std::uint64_t{1} << 30U;

/// The file is open for the life of the object.
class InputFile {
 public:
  /// expected: for messages, for example "a PDB or mmCIF file". Throws LoadError with the file's name if it cannot be
  /// opened, is a directory, or is a device (some, such as /dev/zero, never end).
  InputFile(const std::filesystem::path& path, const std::string& expected) : name_(path.string()) {
    struct stat status {};
    if (::stat(name_.c_str(), &status) != 0) refuse("cannot be opened: ", errno);
    if (S_ISDIR(status.st_mode)) throw LoadError(name_ + ": is a directory, expected " + expected);
    if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode))
      throw LoadError(name_ + ": is a device, expected " + expected);
    is_pipe_ = S_ISFIFO(status.st_mode);
    descriptor_ = ::open(name_.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) refuse("cannot be opened: ", errno);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile() { ::close(descriptor_); }

  /// The path as given. Valid for the life of the object.
  const std::string& name() const noexcept { return name_; }
  /// Number of bytes read so far.
  std::uint64_t position() const noexcept { return position_; }

  /// Reads the next bytes and returns their number; it is less than to.size() only at the end of the file. Throws
  /// LoadError with the file's name if reading fails, or if a pipe gives more than 1 GiB.
  std::size_t read(std::span<char> to) {
    std::size_t done = 0;
    while (done < to.size()) {
      const ssize_t got = ::read(descriptor_, to.data() + done, to.size() - done);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) refuse("cannot be read to its end: ", errno);
      if (got == 0) break;
      done += static_cast<std::size_t>(got);
    }
    position_ += done;
    if (is_pipe_ && position_ > most_piped)
      throw LoadError(name_ + ": is a pipe with more than 1 GiB, expected a regular file for so much data");
    return done;
  }

 private:
  [[noreturn]] void refuse(const char* what, int error) const {
    throw LoadError(name_ + ": " + what + std::strerror(error));
  }

  std::string name_;
  int descriptor_ = -1;
  bool is_pipe_ = false;
  std::uint64_t position_ = 0;
};

/// Returns all bytes of the file. Throws LoadError as InputFile does.
inline std::string read_whole(const std::filesystem::path& path, const std::string& expected = "a file") {
  InputFile file(path, expected);
  std::string bytes;
  std::array<char, std::size_t{1} << 16U> chunk{};
  while (const std::size_t got = file.read(chunk)) bytes.append(chunk.data(), got);
  return bytes;
}

}  // namespace hinge::tool
