// SPDX-License-Identifier: BSD-3-Clause
// A file's bytes.
#pragma once

#include <filesystem>
#include <string>

namespace hinge::robotics {

/// LoadError: no such file, a directory or device, cannot be read, a pipe that gives more than 1 GiB.
std::string read_file(const std::filesystem::path& path);

}  // namespace hinge::robotics
