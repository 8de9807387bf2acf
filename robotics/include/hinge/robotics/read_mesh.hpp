// SPDX-License-Identifier: BSD-3-Clause
// read_mesh: the triangles of STL, OBJ, DAE and PLY files, none dropped, none mended, none invented.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hinge/robotics/shape.hpp"

namespace hinge::robotics {

/// In metres: STL, OBJ and PLY as they are, DAE times its <unit>. Node transforms of a DAE are applied, its up axis is
/// not (the convention of ROS: x, y, z of the file are x, y, z of the link). Coordinates are read in single precision.
/// Polygons are cut into triangles. Lines and points are no surface and are left out; one sentence in `notes`, which
/// names the file, says how many. An STL file is binary when its size is 84 + 50 n bytes, whatever it begins with.
/// LoadError, one line: no such file, another format, cut short, damaged, no triangles, a vertex that is not finite.
TriangleMesh read_mesh(const std::filesystem::path& path, std::vector<std::string>* notes = nullptr);

}  // namespace hinge::robotics
