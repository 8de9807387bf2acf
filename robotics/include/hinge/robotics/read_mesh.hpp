// SPDX-License-Identifier: BSD-3-Clause
// read_mesh: reads all triangles of STL, OBJ, DAE and PLY files, without dropping or repairing any.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/robotics/shape.hpp"

namespace hinge::robotics {

/// Returns the triangles of a mesh file, in m. STL, OBJ and PLY coordinates are taken as metres, DAE coordinates are
/// multiplied by `<unit>`. Node transforms of a DAE file are applied; its up axis is ignored, as ROS does (x, y, z of
/// the file are x, y, z of the link). Numbers in text become the nearest double; numbers in binary files keep their
/// value. Polygons are divided into triangles. Lines and points are skipped; if `notes` is not null, it receives one
/// sentence with the file name and their number, and one if statements of an OBJ file are unknown. An STL file is
/// binary if its size is 84 + 50 n bytes, whatever its first word is. Throws LoadError (one line) if the file is
/// missing, in another format, truncated or damaged, has no triangles, or has a vertex that is not finite.
HINGE_API TriangleMesh read_mesh(const std::filesystem::path& path, std::vector<std::string>* notes = nullptr);

}  // namespace hinge::robotics
