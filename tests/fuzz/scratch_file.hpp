// SPDX-License-Identifier: BSD-3-Clause
// ScratchFile: the input as a file, for readers that need a path; in memory if the system has /dev/shm.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <ios>
#include <string>
#include <string_view>

namespace fuzz {

/// Files are in one folder per process, removed when the process ends normally.
class ScratchFile {
 public:
  ScratchFile(const std::string& name, std::string_view content) : path_(folder() / name) {
    std::ofstream out(path_, std::ios::binary | std::ios::trunc);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
  }
  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  class Folder {
   public:
    Folder() {
      const std::filesystem::path memory = "/dev/shm";
      path = (std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path()) /
             ("hinge_fuzz_" + std::to_string(getpid()));
      std::filesystem::create_directories(path);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
    std::filesystem::path path;
  };
  static const std::filesystem::path& folder() {
    static const Folder folder;
    return folder.path;
  }
  std::filesystem::path path_;
};

}  // namespace fuzz
