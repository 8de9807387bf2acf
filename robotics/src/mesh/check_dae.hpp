// SPDX-License-Identifier: BSD-3-Clause
// check_dae: checks counts, arrays and references of a COLLADA file, because assimp trusts them.
#pragma once

#include <filesystem>
#include <string>

namespace hinge::robotics {

/// Returns the file's text, without libraries that do not concern shapes. Throws LoadError, naming the line, for faults
/// on which assimp 5.2.5 exhausts the memory or the stack: invalid XML, counts or offsets larger than the file,
/// accessors that exceed their arrays, and nodes that contain themselves, are deeper than 500, or expand to more than
/// 10^6. Also throws for geometries and nodes that are not in the file and for controllers, which assimp skips, and as
/// check_dae_mesh() does.
std::string check_dae(const std::filesystem::path& path);

}  // namespace hinge::robotics
