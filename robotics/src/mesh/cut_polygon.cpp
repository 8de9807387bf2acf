// SPDX-License-Identifier: BSD-3-Clause
// Ear clipping (Meisters, "Polygons have ears", 1975), safe for corners that are collinear with others.
#include "mesh/cut_polygon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace hinge::robotics {

namespace {

using Vec2 = std::array<double, 2>;

/// Returns twice the signed area of abc, positive if it is oriented like the polygon.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Drops the coordinate of the axis closest to the normal (Newell: sum of the cross products along the edges). The
/// result runs counter-clockwise.
std::vector<Vec2> flattened(std::span<const Vec3> polygon) {
  Vec3 normal = Vec3::Zero();
  for (std::size_t k = 0; k < polygon.size(); ++k)
    normal += cross(Vec3(polygon[k] - polygon[0]), Vec3(polygon[(k + 1) % polygon.size()] - polygon[0]));
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
  const int x = normal[axis] < 0.0 ? (axis + 2) % 3 : (axis + 1) % 3, y = 3 - axis - x;
  std::vector<Vec2> flat;
  for (const Vec3& vertex : polygon) flat.push_back({vertex[x], vertex[y]});
  return flat;
}

/// Returns true if another vertex lies in the closed triangle abc.
bool holds_another(const std::vector<Vec2>& flat, std::span<const std::size_t> left, const Vec2& a, const Vec2& b,
                   const Vec2& c) {
  return std::any_of(left.begin(), left.end(), [&](std::size_t v) {
    const Vec2& p = flat[v];
    return p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
  });
}

/// Returns a convex corner that can be cut off. If there is none, returns a straight corner, otherwise corner 0: the
/// polygon then crosses itself, and any corner is as good.
std::size_t find_ear(const std::vector<Vec2>& flat, std::span<const std::size_t> left) {
  std::size_t straight = 0;
  for (std::size_t k = 0; k < left.size(); ++k) {
    const Vec2 &a = flat[left[(k + left.size() - 1) % left.size()]], &b = flat[left[k]],
               &c = flat[left[(k + 1) % left.size()]];
    const double area = turn(a, b, c);
    if (area > 0.0 && !holds_another(flat, left, a, b, c)) return k;
    if (area == 0.0) straight = k;
  }
  return straight;
}

}  // namespace

std::vector<Triangle> cut_polygon(std::span<const Vec3> polygon) {
  const std::size_t n = polygon.size();
  if (n <= 3) return {{polygon[0], polygon[std::min<std::size_t>(1, n - 1)], polygon[n - 1]}};
  const std::vector<Vec2> flat = flattened(polygon);
  std::vector<std::size_t> left(n);
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::vector<Triangle> triangles;
  while (left.size() > 3) {
    const std::size_t k = find_ear(flat, left), m = left.size();
    triangles.push_back({polygon[left[(k + m - 1) % m]], polygon[left[k]], polygon[left[(k + 1) % m]]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
  }
  triangles.push_back({polygon[left[0]], polygon[left[1]], polygon[left[2]]});
  return triangles;
}

}  // namespace hinge::robotics
