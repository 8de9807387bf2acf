// SPDX-License-Identifier: BSD-3-Clause
// check_dae: a COLLADA file's counts, indices and node references, before a reader that trusts them.
#pragma once

#include <filesystem>

namespace hinge::robotics {

/// LoadError, naming the line: no XML, a count or offset that the file has no room for, indices that are no whole
/// numbers, nodes that contain themselves or unfold to more than 10^6, or deeper than 500. assimp 5.2.5 fills the
/// memory or the stack over each of them.
void check_dae(const std::filesystem::path& path);

}  // namespace hinge::robotics
