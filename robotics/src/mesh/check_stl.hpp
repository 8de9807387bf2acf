// SPDX-License-Identifier: BSD-3-Clause
// Binary or text, whole or cut short: what an STL file's size and words say before anyone parses it.
#pragma once

#include <cstddef>
#include <string>

namespace hinge::robotics {

/// Number of triangles an STL file announces. LoadError (`path` in front): size and count of a binary file differ, a
/// text without end, nothing of either kind.
std::size_t check_stl(const std::string& bytes, const std::string& path);

}  // namespace hinge::robotics
