// SPDX-License-Identifier: BSD-3-Clause
// read_points: reads the points of a point cloud from a text file.
#pragma once

#include <filesystem>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/vec3.hpp"

namespace hinge::robotics {

/// Returns the points of a text file with one point per line: x, y, z in m, separated by blanks or commas. Further
/// numbers of a line, such as colours, are ignored; `#` starts a comment. Throws LoadError, naming the line, if it does
/// not begin with three finite numbers of at most 2^1000, or if the file has no points or cannot be read.
HINGE_API std::vector<Vec3> read_points(const std::filesystem::path& path);

}  // namespace hinge::robotics
