// SPDX-License-Identifier: BSD-3-Clause
// Descriptors 0, 1 and 2 as a program needs them.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <initializer_list>

namespace hinge::tool {

/// Opens those of the descriptors 0 to 2 that the caller closed, so that no file opened later gets one of them and,
/// with it, text meant for a standard stream. Reading a closed standard input fails, and so does writing to a closed
/// standard output: results are never dropped silently. Notes to a closed standard error are. A file-size limit becomes
/// an error of the write instead of a signal.
inline void prepare_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest free descriptor is this one: those below it are open.
    const int opened = ::open("/dev/null", descriptor == STDOUT_FILENO ? O_RDONLY : O_WRONLY);
    if (opened >= 0 && opened != descriptor) ::close(opened);
  }
  // Such an output fails at its first byte then, before a long run.
  if ((::fcntl(STDOUT_FILENO, F_GETFL) & O_ACCMODE) == O_RDONLY) std::setvbuf(stdout, nullptr, _IONBF, 0);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace hinge::tool
