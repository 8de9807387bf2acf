// SPDX-License-Identifier: BSD-3-Clause
// Merges vertices: equal ones, or those in one cell of a grid (Rossignac & Borrel, Multi-resolution 3D approximations
// for rendering complex scenes, 1993).
#include "page_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/vec3.hpp"

namespace robocd {

namespace {

/// cells: number of cells along the longest side; 0: merge only equal vertices.
PageMesh merged(const std::vector<hinge::Triangle>& triangles, const hinge::Vec3& low, double side, double cells) {
  struct Vertex {
    std::uint32_t index = 0;
    hinge::Vec3 sum = hinge::Vec3::Zero();
    double count = 0.0;
  };
  std::map<std::array<double, 3>, Vertex> vertices;
  PageMesh mesh;
  for (const hinge::Triangle& t : triangles) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const hinge::Vec3& p = k == 0 ? t.a : k == 1 ? t.b : t.c;
      std::array<double, 3> key{p.x(), p.y(), p.z()};
      if (cells > 0.0)
        for (int axis = 0; axis < 3; ++axis)
          key[static_cast<std::size_t>(axis)] = std::floor((p[axis] - low[axis]) / side * cells);
      Vertex& vertex = vertices.try_emplace(key, Vertex{static_cast<std::uint32_t>(vertices.size())}).first->second;
      vertex.sum += p;
      vertex.count += 1.0;
      corners[k] = vertex.index;
    }
    const auto [a, b, c] = corners;
    if (a != b && b != c && c != a) mesh.triangles.insert(mesh.triangles.end(), corners.begin(), corners.end());
  }
  mesh.vertices.resize(3 * vertices.size());
  for (const auto& [key, vertex] : vertices)
    for (int axis = 0; axis < 3; ++axis)
      mesh.vertices[std::size_t{3} * vertex.index + static_cast<std::size_t>(axis)] =
          static_cast<float>(vertex.sum[axis] / vertex.count);
  return mesh;
}

}  // namespace

PageMesh page_mesh(const std::vector<hinge::Triangle>& triangles, std::size_t most) {
  if (triangles.empty()) return {};
  hinge::Vec3 low = triangles.front().a, high = low;
  for (const hinge::Triangle& t : triangles)
    for (const hinge::Vec3* p : {&t.a, &t.b, &t.c}) {
      low = low.cwiseMin(*p);
      high = high.cwiseMax(*p);
    }
  const double side = (high - low).maxCoeff();
  if (triangles.size() <= most || !(side > 0.0)) return merged(triangles, low, side, 0.0);
  constexpr double finest = 256.0, coarsest = 4.0;
  for (double cells = finest;; cells *= 0.75) {
    PageMesh mesh = merged(triangles, low, side, cells);
    if (mesh.triangles.size() <= 3 * most || cells <= coarsest) return mesh;
  }
}

}  // namespace robocd
