// SPDX-License-Identifier: BSD-3-Clause
// TemporaryFile: an exclusively owned new file that is removed when the program ends.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <utility>

#include "hinge/core/error.hpp"

namespace hinge::tool {

namespace temporary {

/// A path for the signal handler to remove. A handler must not lock or allocate, so the paths have static storage.
struct TemporaryPath {
  std::atomic<bool> taken{false};  ///< a TemporaryFile uses this entry
  std::atomic<bool> there{false};  ///< the path is complete and the file exists
  std::array<char, 4096> path{};
};
inline std::array<TemporaryPath, 16> temporary_paths;

extern "C" inline void hinge_remove_temporary_files(int signal) {
  for (const TemporaryPath& entry : temporary_paths)
    if (entry.there) ::unlink(entry.path.data());
  ::raise(signal);  // the default action, restored by SA_RESETHAND
}

/// Handles the signals that end a program from outside, unless the caller ignores (nohup) or handles them.
inline void remove_temporary_files_on_signals() {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGPIPE}) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
    action = {};
    action.sa_handler = hinge_remove_temporary_files;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace temporary

/// Creates an empty file next to `target`, exclusively and under a random name. The file is removed by the destructor,
/// and when SIGHUP, SIGINT, SIGTERM or SIGPIPE ends the program, unless replace_target() renamed it.
class TemporaryFile {
 public:
  /// Throws LoadError with the target's name if the file cannot be created, or if 16 objects exist already.
  explicit TemporaryFile(std::filesystem::path target) : target_(std::move(target)) {
    for (temporary::TemporaryPath& entry : temporary::temporary_paths)
      if (bool taken = false; entry_ == nullptr && entry.taken.compare_exchange_strong(taken, true)) entry_ = &entry;
    if (entry_ == nullptr) throw LoadError(target_.string() + ": cannot be written: too many open temporary files");
    temporary::remove_temporary_files_on_signals();
    try {
      create();
    } catch (...) {
      entry_->taken = false;
      throw;
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (entry_->there) ::unlink(entry_->path.data());
    entry_->there = false;
    entry_->taken = false;
  }

  /// Path of the temporary file. Valid for the life of the object.
  const char* path() const noexcept { return entry_->path.data(); }

  /// Renames the file to the target and replaces an existing file. Throws LoadError if the system refuses.
  void replace_target() {
    if (std::rename(path(), target_.c_str()) != 0) refuse();
    entry_->there = false;
  }

 private:
  [[noreturn]] void refuse() const {
    throw LoadError(target_.string() + ": cannot be written: " + std::strerror(errno));
  }

  void create() {
    constexpr std::size_t longest = 200;  // bytes of the target's name; most file systems allow 255
    constexpr int most_tries = 100;
    const std::string start = (target_.parent_path() / target_.filename().string().substr(0, longest)).string();
    std::random_device random;
    for (int tries = 0; tries < most_tries; ++tries) {
      std::array<char, 32> word{};
      std::snprintf(word.data(), word.size(), ".%08x.partial", static_cast<unsigned>(random()));
      const std::string path = start + word.data();
      if (path.size() >= entry_->path.size()) {
        errno = ENAMETOOLONG;
        break;
      }
      const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);  // minus the umask
      if (descriptor < 0 && errno == EEXIST) continue;
      if (descriptor < 0) break;
      std::memcpy(entry_->path.data(), path.c_str(), path.size() + 1);
      entry_->there = true;
      // Keep the permissions of a replaced file. If the system forbids that, those of the umask stay.
      struct stat old {};
      if (::stat(target_.c_str(), &old) == 0 && ::fchmod(descriptor, old.st_mode & 07777) != 0) errno = 0;
      ::close(descriptor);
      return;
    }
    refuse();
  }

  std::filesystem::path target_;
  temporary::TemporaryPath* entry_ = nullptr;
};

}  // namespace hinge::tool
