// SPDX-License-Identifier: BSD-3-Clause
// A file's bytes.
#pragma once

#include <filesystem>
#include <string>

namespace hinge::robotics {

/// LoadError: no such file, a directory, cannot be read.
std::string read_file(const std::filesystem::path& path);

}  // namespace hinge::robotics
