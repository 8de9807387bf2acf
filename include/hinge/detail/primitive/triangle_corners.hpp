// SPDX-License-Identifier: BSD-3-Clause
// Corners of a triangle, and points on its edges and face given by parameters.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hinge/core/vec3.hpp"

namespace hinge::detail {

using Corners = std::array<Vec3, 3>;

/// Returns the largest magnitude of a coordinate.
inline double largest(const Vec3& v) noexcept { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

/// Returns true when no two of the three signs are opposite.
inline bool same_side(int u, int v, int w) noexcept {
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

inline double clamped(double share) noexcept { return std::min(std::max(share, 0.0), 1.0); }

/// Returns a + s (b - a) for 0 <= s <= 1, computed from the nearer end, with an error of at most one ulp of the
/// coordinates. It uses half lengths, because b - a may overflow.
inline Vec3 on_edge(const Vec3& a, const Vec3& b, double s) noexcept {
  const Vec3 half = b * 0.5 - a * 0.5;
  return s <= 0.5 ? Vec3(a + half * (2.0 * s)) : Vec3(b - half * (2.0 * (1.0 - s)));
}

/// Returns c0 + s (c1 - c0) + t (c2 - c0) for corners c0, c1, c2 with s, t >= 0 and s + t <= 1.
inline Vec3 on_face(const Corners& c, double s, double t) noexcept {
  // Start at the corner with the largest weight. Half lengths as in on_edge.
  const double r = 1.0 - s - t;
  const std::size_t near = r >= s && r >= t ? 0 : s >= t ? 1 : 2;
  const std::array<double, 3> shares{r, s, t};
  const std::size_t i = (near + 1) % 3, j = (near + 2) % 3;
  const Vec3 a = c[near] * 0.5;
  return c[near] + ((c[i] * 0.5 - a) * (2.0 * shares[i]) + (c[j] * 0.5 - a) * (2.0 * shares[j]));
}

}  // namespace hinge::detail
