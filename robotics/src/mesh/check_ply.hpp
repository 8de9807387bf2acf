// SPDX-License-Identifier: BSD-3-Clause
// check_ply: a PLY file's header, before a reader that trusts it.
#pragma once

#include <string>

namespace hinge::robotics {

/// LoadError: a first line other than "ply", a header line that is none, a header without "end_header" (assimp 5.2.5
/// does not return from it), more elements than the file has bytes (for which assimp takes memory first), properties
/// without a name or of an unknown type (which it passes over) and vertices without x, y or z (for which it has 0).
void check_ply(const std::string& bytes, const std::string& path);

}  // namespace hinge::robotics
