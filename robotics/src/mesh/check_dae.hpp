// SPDX-License-Identifier: BSD-3-Clause
// check_dae: a COLLADA file's counts, arrays and references, before a reader that trusts them.
#pragma once

#include <filesystem>
#include <string>

namespace hinge::robotics {

/// The file's text, without what is no shape. LoadError, naming the line: no XML, a count or offset that the file has
/// no room for, accessors beyond their arrays, nodes that contain themselves or unfold to more than 10^6, or deeper
/// than 500, over each of which assimp 5.2.5 fills the memory or the stack; geometries and nodes that are not in the
/// file and bent meshes, which it leaves out; and what check_dae_mesh() says of meshes.
std::string check_dae(const std::filesystem::path& path);

}  // namespace hinge::robotics
