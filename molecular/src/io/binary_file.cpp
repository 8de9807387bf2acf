// SPDX-License-Identifier: BSD-3-Clause
// BinaryFile: uses POSIX pread, which needs no file position, so threads can share the file.
#include "io/binary_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "hinge/core/error.hpp"
#include "io/read_file.hpp"
#include "io/unpacked_file.hpp"

namespace hinge::molecular {

BinaryFile::BinaryFile(const std::filesystem::path& path) : name_(path.string()) {
  struct stat status {};
  if (::stat(name_.c_str(), &status) != 0) throw LoadError(name_ + ": cannot be opened: " + std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw LoadError(name_ + ": is a directory, expected a file of coordinates");
  if (!S_ISREG(status.st_mode))
    throw LoadError(name_ + ": is a pipe or device, expected a regular file, which can be read in any order");
  descriptor_ = ::open(name_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) throw LoadError(name_ + ": cannot be opened: " + std::strerror(errno));
  if (::fstat(descriptor_, &status) != 0 || status.st_size <= 0) {
    ::close(descriptor_);
    throw LoadError(name_ + ": is empty, expected a file of coordinates");
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
  std::array<char, 2> start{};
  if (read(0, start) < 2 || !starts_gzip(start[0], start[1])) return;
  ::close(std::exchange(descriptor_, -1));
  unpacked_ = read_bytes(path);
  size_ = unpacked_.size();
}

BinaryFile::BinaryFile(BinaryFile&& other) noexcept
    : name_(std::move(other.name_)),
      size_(other.size_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      unpacked_(std::move(other.unpacked_)) {}

BinaryFile::~BinaryFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::size_t BinaryFile::read(std::uint64_t offset, std::span<char> to) const {
  if (descriptor_ < 0) {
    const std::size_t first = static_cast<std::size_t>(std::min(offset, size_));
    return unpacked_.copy(to.data(), to.size(), first);
  }
  std::size_t done = 0;
  while (done < to.size()) {
    const ssize_t got = ::pread(descriptor_, to.data() + done, to.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw LoadError(name_ + ": cannot be read: " + std::strerror(errno));
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

void BinaryFile::read_all(std::uint64_t offset, std::span<char> to, const std::string& what) const {
  if (const std::size_t got = read(offset, to); got < to.size())
    throw LoadError(name_ + ": ends at byte " + std::to_string(offset + got) + " inside " + what +
                    ", expected at least " + std::to_string(offset + to.size()) + " bytes; it may be cut short");
}

std::vector<char> BinaryFile::read_all(std::uint64_t offset, std::size_t count, const std::string& what) const {
  // A damaged count may be huge: check it before allocating memory.
  if (offset > size_ || count > size_ - offset)
    throw LoadError(name_ + ": ends at byte " + std::to_string(size_) + " inside " + what + ", which has " +
                    std::to_string(count) + " bytes and starts at byte " + std::to_string(offset) +
                    "; it may be cut short");
  std::vector<char> bytes(count);
  read_all(offset, std::span(bytes), what);
  return bytes;
}

}  // namespace hinge::molecular
