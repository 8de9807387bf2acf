// SPDX-License-Identifier: BSD-3-Clause
// CompleteFile: an output file that is there whole or not at all.
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

/// Writes into a new file beside the wanted one, which takes the wanted name only when it is complete: nothing
/// half-written is left, and of two programs that write to one name at the same time the last one to finish wins,
/// whole. A symbolic link is followed: the file that it names is replaced, the link stays. What is no regular file (a
/// device, a pipe) is written to as it is. Without a path no file is wanted.
class CompleteFile {
 public:
  /// LoadError: cannot be written, or is a directory.
  explicit CompleteFile(std::string path) : path_(std::move(path)) {
    if (!wanted()) return;
    std::error_code error;
    const auto status = std::filesystem::status(path_, error);
    if (status.type() == std::filesystem::file_type::none) {  // such as a circle of links
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

  bool wanted() const noexcept { return !path_.empty(); }
  /// Devices and pipes are not: what was written to them cannot be changed.
  bool is_regular() const noexcept { return is_regular_; }
  std::ofstream& stream() noexcept { return stream_; }

  /// To be called after each piece written, so that a full disk ends the run at once. LoadError: could not be written.
  void check() const {
    if (wanted() && !stream_) refuse();
  }

  /// Closes the file and gives it its name. LoadError: cannot be written.
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

  /// What a chain of symbolic links leads to, whether that exists or not.
  static std::filesystem::path followed(std::filesystem::path path) {
    constexpr int most_links = 40;  // as Linux follows
    std::error_code error;
    for (int links = 0; links < most_links && std::filesystem::is_symlink(path, error); ++links)
      path = path.parent_path() / std::filesystem::read_symlink(path, error);  // an absolute one replaces the left side
    return path;
  }

  std::string path_;
  bool is_regular_ = true;
  std::optional<TemporaryFile> temporary_;
  std::ofstream stream_;
};

}  // namespace hinge::tool
