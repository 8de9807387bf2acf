// SPDX-License-Identifier: BSD-3-Clause
// Tests whether a mesh is closed and whether it contains another mesh. Exact for the given coordinates, no tolerance.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::robotics {

/// A directed edge that occurs in the mesh more often than its reverse. Coordinates in the frame and unit of the mesh.
struct HINGE_API OpenEdge {
  std::size_t triangle = 0;  ///< index of a triangle that has the edge
  Vec3 from = Vec3::Zero();  ///< first vertex of the edge
  Vec3 to = Vec3::Zero();    ///< second vertex of the edge

  /// Returns a description such as "edge (0, 0, 0) - (1, 0, 0) of triangle 3".
  std::string text() const;
};

/// Returns the first open edge of the mesh, or nothing if the mesh is closed. A mesh is closed if every edge occurs
/// equally often in both directions. Vertices are identified by equal coordinates, which must be finite. O(n log n) for
/// n triangles.
HINGE_API std::optional<OpenEdge> open_edge(std::span<const Triangle> mesh);
/// Returns true if the mesh has no open edge.
inline bool closed(std::span<const Triangle> mesh) { return !open_edge(mesh).has_value(); }

/// Returns for each triangle the index of the first triangle of its connected component. Triangles that share a vertex
/// are connected. Result: mesh.size() values.
HINGE_API std::vector<std::size_t> part_numbers(std::span<const Triangle> mesh);
/// Returns the index of the first triangle of each connected component, sorted.
HINGE_API std::vector<std::size_t> parts(std::span<const Triangle> mesh);

/// Position of a point relative to a closed mesh.
enum class Place : unsigned char { outside, on_surface, inside };

/// Returns the position of a point relative to a closed mesh, both in one frame, finite coordinates. A point is inside
/// if the winding number of the surface about it is not 0. Overlapping or nested components therefore act as their
/// union. A cavity, oriented opposite to its outer surface, is outside.
HINGE_API Place place_of(const Vec3& point, std::span<const Triangle> closed_mesh) noexcept;

/// How much of a mesh lies inside another one: no connected component, some of them, or all.
enum class Containment : unsigned char { none, some_parts, whole };

/// Returns how much of `inner` lies inside the closed mesh `outer`. Both meshes are in one frame and their surfaces
/// must not touch: a component is then inside if one of its vertices is.
HINGE_API Containment contains(std::span<const Triangle> closed_outer, std::span<const Triangle> inner);
/// The same, with precomputed inner_parts = parts(inner).
HINGE_API Containment contains(std::span<const Triangle> closed_outer, std::span<const Triangle> inner,
                               std::span<const std::size_t> inner_parts) noexcept;

}  // namespace hinge::robotics
