// SPDX-License-Identifier: BSD-3-Clause
// CompleteFile: an output file that is written completely or not at all.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge_tools/temporary_file.hpp"

namespace hinge::tool {

/// Writes to a temporary file next to the target. finish() renames it, so no partial file is left; if two programs
/// write the same target, the last to finish wins. A symbolic link is followed: its target is replaced, the link stays.
/// A device or pipe is written directly. An empty path means that no file is wanted.
class CompleteFile {
 public:
  /// Throws LoadError if the path cannot be written or is a directory.
  explicit CompleteFile(std::string path) : path_(std::move(path)) {
    if (!wanted()) return;
    std::error_code error;
    const auto status = std::filesystem::status(path_, error);
    if (status.type() == std::filesystem::file_type::none) {  // for example a cycle of links
      errno = error.value();
      refuse();
    }
    if (std::filesystem::is_directory(status)) throw LoadError(path_ + ": is a directory, expected a file to write");
    const bool exists = std::filesystem::exists(status);
    if (exists && ::access(path_.c_str(), W_OK) != 0) refuse();
    is_regular_ = !exists || std::filesystem::is_regular_file(status);
    if (is_regular_) temporary_.emplace(followed(path_));
    errno = 0;
    stream_.open(is_regular_ ? temporary_->path() : path_.c_str(), std::ios::binary);
    check();
  }

  /// True if the path is not empty.
  bool wanted() const noexcept { return !path_.empty(); }
  /// False for devices and pipes: bytes written to them cannot be taken back.
  bool is_regular() const noexcept { return is_regular_; }
  /// The stream to write to. Valid for the life of the object.
  std::ofstream& stream() noexcept { return stream_; }

  /// Call this after each piece of output, so that a full disk ends the run at once. Throws LoadError if a write
  /// failed.
  void check() const {
    if (wanted() && !stream_) refuse();
  }

  /// Closes the file and gives it its final name. Throws LoadError if that fails.
  void finish() {
    if (!wanted()) return;
    check();
    errno = 0;
    stream_.close();
    check();
    if (temporary_) temporary_->replace_target();
  }

 private:
  [[noreturn]] void refuse() const {
    throw LoadError(path_ + ": cannot be written: " + std::strerror(errno != 0 ? errno : EIO));
  }

  /// The end of a chain of symbolic links, whether it exists or not.
  static std::filesystem::path followed(std::filesystem::path path) {
    constexpr int most_links = 40;  // the limit of Linux
    std::error_code error;
    for (int links = 0; links < most_links && std::filesystem::is_symlink(path, error); ++links)
      // an absolute target replaces the left side
      path = path.parent_path() / std::filesystem::read_symlink(path, error);
    return path;
  }

  std::string path_;
  bool is_regular_ = true;
  std::optional<TemporaryFile> temporary_;
  std::ofstream stream_;
};

}  // namespace hinge::tool
