// SPDX-License-Identifier: BSD-3-Clause
// prepare_standard_streams: makes descriptors 0, 1 and 2 safe to use.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <initializer_list>

namespace hinge::tool {

/// Opens the descriptors 0 to 2 that the caller closed. Otherwise, a file opened later could get one of them, and
/// receive text for a standard stream. Reading from a closed standard input and writing to a closed standard output
/// fail, so results are never lost silently. Notes to a closed standard error are dropped. Exceeding the file-size
/// limit becomes a write error instead of a signal.
inline void prepare_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    // open() returns the lowest free descriptor, which is this one: all lower ones are open.
    const int opened = ::open("/dev/null", descriptor == STDOUT_FILENO ? O_RDONLY : O_WRONLY);
    if (opened >= 0 && opened != descriptor) ::close(opened);
  }
  // Unbuffered, so that a closed output fails at its first byte, before a long run.
  if ((::fcntl(STDOUT_FILENO, F_GETFL) & O_ACCMODE) == O_RDONLY) std::setvbuf(stdout, nullptr, _IONBF, 0);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace hinge::tool
