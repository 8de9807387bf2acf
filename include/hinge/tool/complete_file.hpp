// SPDX-License-Identifier: BSD-3-Clause
// CompleteFile: an output file that is there whole or not at all.
#pragma once

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "hinge/core/error.hpp"

namespace hinge::tool {

/// Writes beside the wanted file and takes its name only when complete, so that nothing half-written is left. Without a
/// path no file is wanted.
class CompleteFile {
 public:
  /// LoadError: cannot be written.
  explicit CompleteFile(std::string path) : path_(std::move(path)) {
    if (!wanted()) return;
    stream_.open(partial());
    if (!stream_) throw LoadError(path_ + ": cannot be written: " + std::strerror(errno));
  }
  CompleteFile(const CompleteFile&) = delete;
  CompleteFile& operator=(const CompleteFile&) = delete;
  ~CompleteFile() {
    std::error_code ignored;
    if (wanted()) std::filesystem::remove(partial(), ignored);
  }

  bool wanted() const noexcept { return !path_.empty(); }
  std::ofstream& stream() noexcept { return stream_; }

  /// Closes the file and gives it its name. LoadError: cannot be written.
  void finish() {
    if (!wanted()) return;
    stream_.close();
    if (!stream_) throw LoadError(path_ + ": cannot be written: " + std::strerror(errno));
    std::filesystem::rename(partial(), path_);
  }

 private:
  std::string partial() const { return path_ + ".partial"; }

  std::string path_;
  std::ofstream stream_;
};

}  // namespace hinge::tool
