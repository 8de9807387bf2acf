// SPDX-License-Identifier: BSD-3-Clause
// Containment: is a surface closed, and does another one lie inside it? Exact for the coordinates given, no tolerance.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::robotics {

/// An edge that is run through more often in this direction than in the other.
struct OpenEdge {
  std::size_t triangle = 0;  ///< one it belongs to
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();

  /// "edge (0, 0, 0) - (1, 0, 0) of triangle 3"
  std::string text() const;
};

/// The first edge that keeps the triangles from being closed; none: they are. Closed: every edge is run through equally
/// often in both directions, vertices being equal when their coordinates are. Coordinates finite.
std::optional<OpenEdge> open_edge(std::span<const Triangle> mesh);
inline bool closed(std::span<const Triangle> mesh) { return !open_edge(mesh).has_value(); }

/// For each triangle the first triangle of its part; triangles that share a vertex are of one part.
std::vector<std::size_t> part_numbers(std::span<const Triangle> mesh);
/// The first triangle of each part, sorted.
std::vector<std::size_t> parts(std::span<const Triangle> mesh);

enum class Place : unsigned char { outside, on_surface, inside };

/// Where a point lies against a closed mesh. Inside: the surface winds around it, so that overlapping or nested parts
/// count as their union and a cavity, whose surface is oriented against its outer one, as outside. Finite coordinates.
Place place_of(const Vec3& point, std::span<const Triangle> closed_mesh) noexcept;

enum class Containment : unsigned char { none, some_parts, whole };

/// How much of `inner` lies inside the closed `outer`, when their surfaces do not meet: with no contact each part is
/// inside or outside as one of its vertices is.
Containment contains(std::span<const Triangle> closed_outer, std::span<const Triangle> inner);
/// The same with parts(inner) at hand.
Containment contains(std::span<const Triangle> closed_outer, std::span<const Triangle> inner,
                     std::span<const std::size_t> inner_parts) noexcept;

}  // namespace hinge::robotics
