// SPDX-License-Identifier: BSD-3-Clause
// PageMesh: the triangles of a link or body as a page draws them, with shared vertices, coarser if there are too many.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hinge/primitive/triangle.hpp"

namespace robocd {

/// Vertices (m) and triangles of three vertices each.
struct PageMesh {
  std::vector<float> vertices;           ///< x, y, z of each
  std::vector<std::uint32_t> triangles;  ///< three indices each
};

/// Returns the mesh of the triangles. If they are more than `most`, vertices in one cell of a grid become one, in
/// cells as small as `most` allows.
PageMesh page_mesh(const std::vector<hinge::Triangle>& triangles, std::size_t most);

}  // namespace robocd
