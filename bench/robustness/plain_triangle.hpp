// SPDX-License-Identifier: BSD-3-Clause
// PlainTriangle: Triangle with decisions by the signs that double arithmetic gives, with the same kernels. It is the
// baseline for the time of exact decisions.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/primitive/triangle_corners.hpp"
#include "hinge/detail/primitive/triangle_distance.hpp"
#include "hinge/detail/primitive/triangle_leaf.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::bench {

/// The steps of hinge::detail::meeting_if_clear (Guigue & Devillers 2003) with an error bound of 0: computed signs
/// are trusted, and three heights equal to 0 mean coplanar triangles.
namespace plain_double {

using Heights = std::array<double, 3>;

/// Heights of `points` above the plane of t, times the length of its normal.
inline Heights heights(const detail::Corners& t, const detail::Corners& points) noexcept {
  const Vec3 normal = cross(Vec3(t[1] - t[0]), Vec3(t[2] - t[0]));
  return {dot(normal, Vec3(points[0] - t[0])), dot(normal, Vec3(points[1] - t[0])),
          dot(normal, Vec3(points[2] - t[0]))};
}
inline bool one_side(const Heights& h) noexcept {
  return std::min({h[0], h[1], h[2]}) > 0.0 || std::max({h[0], h[1], h[2]}) < 0.0;
}

/// A corner in the plane counts to the side that leaves one corner alone.
inline detail::Cut cut(const Heights& h) noexcept {
  const bool none_above = std::max({h[0], h[1], h[2]}) <= 0.0;
  const auto above = [&](std::size_t k) { return none_above ? h[k] >= 0.0 : h[k] > 0.0; };
  const bool p = above(0), q = above(1), r = above(2);
  const std::size_t lone = q == r ? 0 : p == r ? 1 : 2;
  return {lone, above(lone)};
}

/// Whether two coplanar triangles share a point.
inline bool in_plane(const detail::Corners& x, const detail::Corners& y, const Vec3& normal) noexcept {
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const auto turn = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
  };
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t l = 0; l < 3; ++l) {
      const Vec3 &p = x[k], &q = x[(k + 1) % 3], &r = y[l], &s = y[(l + 1) % 3];
      if (turn(p, q, r) * turn(p, q, s) <= 0.0 && turn(r, s, p) * turn(r, s, q) <= 0.0) return true;
    }
  const auto holds = [&](const detail::Corners& t, const Vec3& p) {
    const double u = turn(t[0], t[1], p), v = turn(t[1], t[2], p), w = turn(t[2], t[0], p);
    return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
  };
  return holds(x, y[0]) || holds(y, x[0]);
}

/// Whether two triangles share a point, by computed signs.
inline bool intersect(const detail::Corners& x, const detail::Corners& y) noexcept {
  const Heights of_x = heights(y, x);
  if (one_side(of_x)) return false;
  const Heights of_y = heights(x, y);
  if (one_side(of_y)) return false;
  if (of_x[0] == 0.0 && of_x[1] == 0.0 && of_x[2] == 0.0)
    return in_plane(x, y, cross(Vec3(y[1] - y[0]), Vec3(y[2] - y[0])));
  const detail::Cut in_x = cut(of_x), in_y = cut(of_y);
  const Vec3 &p = x[in_x.lone], &q = y[in_y.lone];
  const std::size_t turn_x = in_y.positive ? 1 : 2, turn_y = in_x.positive ? 1 : 2;
  const Vec3 &x1 = x[(in_x.lone + turn_x) % 3], &x2 = x[(in_x.lone + 3 - turn_x) % 3];
  const Vec3 &y1 = y[(in_y.lone + turn_y) % 3], &y2 = y[(in_y.lone + 3 - turn_y) % 3];
  const Vec3 across = q - p;
  if (dot(Vec3(x1 - p), cross(across, Vec3(y1 - p))) > 0.0) return false;
  return !(dot(Vec3(x2 - p), cross(Vec3(y2 - p), across)) > 0.0);
}

/// Flattened, so that the compiler drops the lower bound, which only exact decisions use.
[[gnu::flatten, gnu::noinline]] inline double squared(const detail::TrianglePair& pair) noexcept {
  return pair.nearest().squared;
}

}  // namespace plain_double

/// A triangle with plain double decisions.
struct PlainTriangle {
  Triangle triangle;
  static constexpr bool fills_hull = true;  ///< as Triangle: the same kernels

  PlainTriangle placed(const Pose& pose) const noexcept { return {triangle.placed(pose)}; }
  Aabb bounds() const noexcept { return triangle.bounds(); }
  std::array<Vec3, 3> hull() const noexcept { return triangle.hull(); }
  static constexpr double hull_radius() noexcept { return 0.0; }

  friend double squared_distance(const PlainTriangle& p, const PlainTriangle& q) noexcept {
    const detail::Corners x = p.corners(), y = q.corners();
    if (!apart(p.bounds(), q.bounds(), 0.0) && plain_double::intersect(x, y)) return 0.0;
    return plain_double::squared(detail::TrianglePair(x, y));
  }
  friend bool closer_than(const PlainTriangle& p, const PlainTriangle& q, double m) noexcept {
    const Aabb around_p = p.bounds(), around_q = q.bounds();
    if (apart(around_p, around_q, m)) return false;
    const detail::Corners x = p.corners(), y = q.corners();
    if (!apart(around_p, around_q, 0.0) && plain_double::intersect(x, y)) return true;
    if (!(m > 0.0)) return false;
    const detail::TrianglePair pair(x, y);
    return !pair.planes_apart(m) && plain_double::squared(pair) < m * m;
  }
  /// Engines store these points to remember a pair.
  friend std::pair<Vec3, Vec3> closest_points(const PlainTriangle& p, const PlainTriangle& q) noexcept {
    const detail::TrianglePair pair(p.corners(), q.corners());
    const auto nearest = pair.nearest();
    return {pair.placed(nearest.p), pair.placed(nearest.q)};
  }

 private:
  detail::Corners corners() const noexcept { return {triangle.a, triangle.b, triangle.c}; }
  static bool apart(const Aabb& p, const Aabb& q, double m) noexcept {
    bool any = false;
    for (int k = 0; k < 3; ++k) any |= p.lower[k] - q.upper[k] > m || q.lower[k] - p.upper[k] > m;
    return any;
  }
};

static_assert(HasClosestPoints<PlainTriangle> && detail::UsesStaticBvh<PlainTriangle>);

}  // namespace hinge::bench
