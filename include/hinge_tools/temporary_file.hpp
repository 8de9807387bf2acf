// SPDX-License-Identifier: BSD-3-Clause
// TemporaryFile: a new file of one's own that does not outlive the program.
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

/// What a signal handler has to remove. A handler may neither lock nor allocate, so the paths stand in a fixed place.
struct TemporaryPath {
  std::atomic<bool> taken{false};  ///< a TemporaryFile uses this entry
  std::atomic<bool> there{false};  ///< the path is complete and its file exists
  std::array<char, 4096> path{};
};
inline std::array<TemporaryPath, 16> temporary_paths;

extern "C" inline void hinge_remove_temporary_files(int signal) {
  for (const TemporaryPath& entry : temporary_paths)
    if (entry.there) ::unlink(entry.path.data());
  ::raise(signal);  // the default action, which SA_RESETHAND has put back
}

/// The signals that end a program from outside. Those that the caller ignores (nohup) or handles are left alone.
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

/// An empty file beside `target`, under a name that no other program uses: it is created exclusively. It is removed
/// with the object, and when SIGHUP, SIGINT, SIGTERM or SIGPIPE ends the program, unless it has taken its target's
/// place before.
class TemporaryFile {
 public:
  /// LoadError naming the target: cannot be created, or 16 exist already.
  explicit TemporaryFile(std::filesystem::path target) : target_(std::move(target)) {
    for (temporary::TemporaryPath& entry : temporary::temporary_paths)
      if (bool taken = false; entry_ == nullptr && entry.taken.compare_exchange_strong(taken, true)) entry_ = &entry;
    if (entry_ == nullptr) throw LoadError(target_.string() + ": cannot be written: too many files at once");
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

  const char* path() const noexcept { return entry_->path.data(); }

  /// Takes the target's name; a file of that name is replaced. LoadError: the system refuses it.
  void replace_target() {
    if (std::rename(path(), target_.c_str()) != 0) refuse();
    entry_->there = false;
  }

 private:
  [[noreturn]] void refuse() const {
    throw LoadError(target_.string() + ": cannot be written: " + std::strerror(errno));
  }

  void create() {
    constexpr std::size_t longest = 200;  // bytes of the target's name: names of 255 bytes are the most that exist
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
      const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);  // less the umask
      if (descriptor < 0 && errno == EEXIST) continue;
      if (descriptor < 0) break;
      std::memcpy(entry_->path.data(), path.c_str(), path.size() + 1);
      entry_->there = true;
      // A file that is replaced keeps its permissions. Where the system forbids that, those of the umask stay.
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
