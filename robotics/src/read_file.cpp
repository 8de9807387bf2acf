// SPDX-License-Identifier: BSD-3-Clause
// Reading whole files.
#include "read_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include "hinge/core/error.hpp"

namespace hinge::robotics {

std::string read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw LoadError(path.string() + ": is a directory, expected a file");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw LoadError(path.string() + ": cannot be opened: " + std::strerror(errno != 0 ? errno : ENOENT));
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw LoadError(path.string() + ": cannot be read to its end");
  return bytes;
}

}  // namespace hinge::robotics
