// SPDX-License-Identifier: BSD-3-Clause
// check_ply: checks the header of a PLY file, because assimp trusts it.
#pragma once

#include <string>

namespace hinge::robotics {

/// Throws LoadError if the first line is not "ply", a header line is invalid, "end_header" is missing (assimp 5.2.5
/// does not return then), a count exceeds the number of bytes (assimp allocates memory for it), a property has no name
/// or an unknown type (assimp skips it), or vertices have no x, y or z (assimp uses 0).
void check_ply(const std::string& bytes, const std::string& path);

}  // namespace hinge::robotics
