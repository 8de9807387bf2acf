// SPDX-License-Identifier: BSD-3-Clause
// check_stl: detects binary and text STL files and truncated ones, before they are parsed.
#pragma once

#include <cstddef>
#include <string>

namespace hinge::robotics {

/// Returns the number of triangles that an STL file announces. Throws LoadError (starting with `path`) if size and
/// count of a binary file differ, a text file has no end, or it is neither.
std::size_t check_stl(const std::string& bytes, const std::string& path);

}  // namespace hinge::robotics
