// SPDX-License-Identifier: BSD-3-Clause
// Exact intersection test of two closed triangles, for all finite doubles. Degenerate triangles are the segments or
// points that their corners span.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hinge/core/finite.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/exact/error_free.hpp"
#include "hinge/detail/exact/orient.hpp"
#include "hinge/detail/primitive/triangle_corners.hpp"

namespace hinge::detail {

/// The sides of a triangle's plane on which the corners of another triangle lie (signs). All 0 when the triangle is
/// degenerate.
struct Sides {
  std::array<int, 3> sign{};

  bool one_side() const noexcept {
    return (sign[0] > 0 && sign[1] > 0 && sign[2] > 0) || (sign[0] < 0 && sign[1] < 0 && sign[2] < 0);
  }
};

/// Returns the sides of `points` relative to the plane of t. One error bound in double serves the three points.
/// Rounding: edges and w are accurate to half an ulp, so each of the six triple products is within 7 half ulps of
/// |u|max |v|max |w|max. Underflow adds at most a few times 2^-1074 (1 + |w|max).
inline Sides sides_of(const Corners& t, const Corners& points) noexcept {
  constexpr double relative = 48 * exact::half_ulp, absolute = 0x1p-1069;
  const Vec3 u = t[1] - t[0], v = t[2] - t[0], normal = cross(u, v);
  const double size = relative * largest(u) * largest(v);
  Sides sides;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 w = points[k] - t[0];
    const double height = dot(w, normal), reach = largest(w);
    // Overflow gives infinity or NaN in the end; its sign has no meaning, since other terms may be larger.
    const bool sure = is_finite(height) && std::abs(height) > size * reach + absolute * (1.0 + reach);
    sides.sign[k] = sure ? exact::sign_of(height) : exact::orient3d(points[k], t[1], t[2], t[0]);
  }
  return sides;
}

/// Returns true when segment pq meets the triangle. The line of pq must meet the plane in a single point, inside the
/// segment.
inline bool pierces(const Vec3& p, const Vec3& q, const Corners& t) noexcept {
  const int u = exact::orient3d(t[0], t[1], q, p), v = exact::orient3d(t[1], t[2], q, p);
  if (u * v < 0) return false;
  return same_side(u, v, exact::orient3d(t[2], t[0], q, p));
}

/// Returns true when an edge of x that is not in the plane of y meets y.
inline bool any_pierces(const Corners& x, const Sides& of_x, const Corners& y) noexcept {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    const int p = of_x.sign[k], q = of_x.sign[l];
    if (p * q <= 0 && p != q && pierces(x[k], x[l], y)) return true;
  }
  return false;
}

/// Returns true when the closed boxes around pq and rs share a point.
inline bool boxes_meet(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) noexcept {
  for (int k = 0; k < 3; ++k)
    if (std::max(p[k], q[k]) < std::min(r[k], s[k]) || std::max(r[k], s[k]) < std::min(p[k], q[k])) return false;
  return true;
}

/// Returns true when two closed segments (possibly points) share a point. They must be coplanar and meet in the
/// projection along every axis. The projection along the largest component of the normal loses nothing; the others are
/// redundant. Each projection is tested by the boxes and by the sides of the ends.
inline bool segments_meet(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) noexcept {
  if (!boxes_meet(p, q, r, s) || exact::orient3d(p, q, r, s) != 0) return false;
  for (int axis = 0; axis < 3; ++axis) {
    if (exact::orient2d(p, q, r, axis) * exact::orient2d(p, q, s, axis) > 0) return false;
    if (exact::orient2d(r, s, p, axis) * exact::orient2d(r, s, q, axis) > 0) return false;
  }
  return true;
}

/// Returns true when p, a point in the plane of t, lies in t, tested in the projection along every axis. The box test
/// serves degenerate triangles.
inline bool holds(const Corners& t, const Vec3& p) noexcept {
  for (int k = 0; k < 3; ++k)
    if (p[k] < std::min({t[0][k], t[1][k], t[2][k]}) || p[k] > std::max({t[0][k], t[1][k], t[2][k]})) return false;
  for (int axis = 0; axis < 3; ++axis) {
    if (!same_side(exact::orient2d(t[0], t[1], p, axis), exact::orient2d(t[1], t[2], p, axis),
                   exact::orient2d(t[2], t[0], p, axis)))
      return false;
  }
  return true;
}

/// For triangles with an edge in the plane of the other triangle, or where the other triangle is degenerate.
inline bool meet_in_plane(const Corners& x, const Sides& of_x, const Corners& y, const Sides& of_y) noexcept {
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t l = 0; l < 3; ++l)
      if (segments_meet(x[k], x[(k + 1) % 3], y[l], y[(l + 1) % 3])) return true;
  for (std::size_t k = 0; k < 3; ++k)
    if ((of_x.sign[k] == 0 && holds(y, x[k])) || (of_y.sign[k] == 0 && holds(x, y[k]))) return true;
  return false;
}

/// Two convex sets without volume meet where an edge of one meets the other. This edge passes through the other's plane
/// at one point, or it lies in that plane. In the second case it meets an edge of the other, or its ends are inside.
[[gnu::noinline]] inline bool intersect_by_edges(const Corners& x, const Corners& y) noexcept {
  for (const Vec3& p : x)  // a shared corner is the most frequent contact
    for (const Vec3& q : y)
      if (p == q) return true;
  const Sides of_x = sides_of(y, x);
  if (of_x.one_side()) return false;
  const Sides of_y = sides_of(x, y);
  if (of_y.one_side()) return false;
  if (any_pierces(x, of_x, y) || any_pierces(y, of_y, x)) return true;
  const auto two_zeros = [](const Sides& s) noexcept {
    return (s.sign[0] == 0) + (s.sign[1] == 0) + (s.sign[2] == 0) >= 2;
  };
  return (two_zeros(of_x) || two_zeros(of_y)) && meet_in_plane(x, of_x, y, of_y);
}

/// A triangle cut by a plane: corner `lone` lies alone on its side. positive: this is the positive side.
struct Cut {
  std::size_t lone = 0;
  bool positive = false;
};

/// Requires two heights on one side and one on the other.
inline Cut cut(const std::array<double, 3>& height) noexcept {
  const bool p = height[0] > 0.0, q = height[1] > 0.0, r = height[2] > 0.0;
  const std::size_t lone = q == r ? 0 : p == r ? 1 : 2;
  return {lone, height[lone] > 0.0};
}

enum class Meeting { apart, together, open };

/// Decides with a single bound on all rounding errors, or returns open (Guigue & Devillers, "Fast and robust
/// triangle-triangle overlap test using orientation predicates", Journal of Graphics Tools 8, 2003). extent: the
/// largest coordinate difference along an axis.
inline Meeting meeting_if_clear(const Corners& x, const Corners& y, double extent) noexcept {
  // The error of six products of three differences, each accurate to half an ulp, is within 7 half ulps of extent^3
  // each.
  if (!(extent >= 0x1p-150 && extent <= 0x1p150)) return Meeting::open;  // products would overflow or underflow
  const double rounding = 48 * exact::half_ulp * (extent * extent * extent);
  const auto heights = [](const Corners& t, const Corners& points) noexcept {
    const Vec3 normal = cross(Vec3(t[1] - t[0]), Vec3(t[2] - t[0]));
    return std::array<double, 3>{dot(normal, Vec3(points[0] - t[0])), dot(normal, Vec3(points[1] - t[0])),
                                 dot(normal, Vec3(points[2] - t[0]))};
  };
  const auto beyond = [rounding](const std::array<double, 3>& h) noexcept {
    return std::min({h[0], h[1], h[2]}) > rounding || std::max({h[0], h[1], h[2]}) < -rounding;
  };
  const auto all_clear = [rounding](const std::array<double, 3>& h) noexcept {
    return std::min({std::abs(h[0]), std::abs(h[1]), std::abs(h[2])}) > rounding;
  };
  const std::array<double, 3> of_x = heights(y, x);
  if (beyond(of_x)) return Meeting::apart;
  const std::array<double, 3> of_y = heights(x, y);
  if (beyond(of_y)) return Meeting::apart;
  if (!all_clear(of_x) || !all_clear(of_y)) return Meeting::open;

  // Each triangle cuts the common line of the planes in an interval. It ends on the two edges of the lone corner.
  const Cut in_x = cut(of_x), in_y = cut(of_y);
  const Vec3 &p = x[in_x.lone], &q = y[in_y.lone];
  const std::size_t turn_x = in_y.positive ? 1 : 2, turn_y = in_x.positive ? 1 : 2;
  const Vec3 &x1 = x[(in_x.lone + turn_x) % 3], &x2 = x[(in_x.lone + 3 - turn_x) % 3];
  const Vec3 &y1 = y[(in_y.lone + turn_y) % 3], &y2 = y[(in_y.lone + 3 - turn_y) % 3];
  const Vec3 across = q - p;
  const double first = dot(Vec3(x1 - p), cross(across, Vec3(y1 - p)));
  const double second = dot(Vec3(x2 - p), cross(Vec3(y2 - p), across));
  if (first > rounding || second > rounding) return Meeting::apart;
  return first < -rounding && second < -rounding ? Meeting::together : Meeting::open;
}

/// Returns true when the closed triangles share a point. extent: the largest coordinate difference along an axis; 0
/// skips the bound.
inline bool intersect(const Corners& x, const Corners& y, double extent) noexcept {
  const Meeting clear = meeting_if_clear(x, y, extent);
  return clear == Meeting::open ? intersect_by_edges(x, y) : clear == Meeting::together;
}

}  // namespace hinge::detail
