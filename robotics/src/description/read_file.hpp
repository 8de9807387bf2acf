// SPDX-License-Identifier: BSD-3-Clause
// read_file: reads a file as bytes.
#pragma once

#include <filesystem>
#include <string>

namespace hinge::robotics {

/// Returns all bytes of a file. Throws LoadError if it does not exist, is a directory or device, cannot be read, or is
/// a pipe with more than 1 GiB.
std::string read_file(const std::filesystem::path& path);

}  // namespace hinge::robotics
