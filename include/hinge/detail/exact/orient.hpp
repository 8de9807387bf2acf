// SPDX-License-Identifier: BSD-3-Clause
// orient2d, orient3d: the exact side of a point relative to a line or a plane, for all finite doubles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/exact/error_free.hpp"
#include "hinge/detail/exact/integer.hpp"

namespace hinge::detail::exact {

inline int sign_of(double x) noexcept { return (x > 0.0 ? 1 : 0) - (x < 0.0 ? 1 : 0); }

/// A point with integer coordinates in units of one power of two.
using WholePoint = std::array<Integer, 3>;

inline constexpr int no_unit = std::numeric_limits<int>::max();  // all coordinates are 0: any unit is valid

/// Returns the largest e <= unit for which every coordinate is a multiple of 2^e.
inline int common_unit(std::span<const Vec3> points, int unit = no_unit) noexcept {
  for (const Vec3& p : points)
    for (int k = 0; k < 3; ++k) unit = std::min(unit, unit_exponent(p[k], no_unit));
  return unit;
}

/// Returns a - b in units of 2^unit.
[[gnu::noinline]] inline WholePoint whole_difference(const Vec3& a, const Vec3& b, int unit) noexcept {
  return {Integer::of(a[0], unit) - Integer::of(b[0], unit), Integer::of(a[1], unit) - Integer::of(b[1], unit),
          Integer::of(a[2], unit) - Integer::of(b[2], unit)};
}

inline WholePoint operator-(const WholePoint& a, const WholePoint& b) noexcept {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

[[gnu::noinline]] inline Integer dot(const WholePoint& a, const WholePoint& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

[[gnu::noinline]] inline WholePoint cross(const WholePoint& a, const WholePoint& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Returns (a x b) . c. It is out of line, like the functions below: an Integer takes 1.6 KiB, and the temporaries
/// would enlarge the caller's stack frame.
[[gnu::noinline]] inline Integer triple(const WholePoint& a, const WholePoint& b, const WholePoint& c) noexcept {
  return dot(cross(a, b), c);
}

/// The exact stage, in integers. It measured faster than expansions (0.24 against 0.33 us), and it has no limits on
/// exponents.
[[gnu::cold, gnu::noinline]] inline int orient3d_in_integers(const Vec3& a, const Vec3& b, const Vec3& c,
                                                             const Vec3& d) noexcept {
  const std::array<Vec3, 4> points{a, b, c, d};
  const int unit = common_unit(points);
  if (unit == no_unit) return 0;
  return dot(whole_difference(a, d, unit), cross(whole_difference(b, d, unit), whole_difference(c, d, unit))).sign();
}

/// Returns the sign of (a - d) . ((b - d) x (c - d)): 0 when the four points are coplanar, 1 when a, b, c appear
/// clockwise from d. The filter is that of Shewchuk 1997, fig. 21, with margins for its own rounding and for underflow.
/// Overflow gives infinity or NaN, which fails the comparison.
inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  constexpr double relative = 8 * half_ulp, absolute = 0x1p-1070;
  const double ax = a[0] - d[0], ay = a[1] - d[1], az = a[2] - d[2];
  const double bx = b[0] - d[0], by = b[1] - d[1], bz = b[2] - d[2];
  const double cx = c[0] - d[0], cy = c[1] - d[1], cz = c[2] - d[2];
  const double bxcy = bx * cy, cxby = cx * by, cxay = cx * ay, axcy = ax * cy, axby = ax * by, bxay = bx * ay;
  const double det = az * (bxcy - cxby) + bz * (cxay - axcy) + cz * (axby - bxay);
  const double size_a = std::abs(az), size_b = std::abs(bz), size_c = std::abs(cz);
  const double permanent = (std::abs(bxcy) + std::abs(cxby)) * size_a + (std::abs(cxay) + std::abs(axcy)) * size_b +
                           (std::abs(axby) + std::abs(bxay)) * size_c;
  if (std::abs(det) > relative * permanent + absolute * (1.0 + size_a + size_b + size_c)) return sign_of(det);
  return orient3d_in_integers(a, b, c, d);
}

[[gnu::cold, gnu::noinline]] inline int orient2d_in_integers(const Vec3& a, const Vec3& b, const Vec3& c,
                                                             int axis) noexcept {
  const std::array<Vec3, 3> points{a, b, c};
  const int unit = common_unit(points);
  if (unit == no_unit) return 0;
  const auto k = static_cast<std::size_t>(axis);
  return cross(whole_difference(a, c, unit), whole_difference(b, c, unit))[k].sign();
}

/// Returns the orientation of three points projected along `axis`: 1 for counterclockwise, 0 for collinear, -1 for
/// clockwise. The other two coordinates are taken in cyclic order, so the three signs are those of the normal.
inline int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis) noexcept {
  constexpr double relative = 4 * half_ulp, absolute = 0x1p-1070;  // as in orient3d
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  const double left = (a[x] - c[x]) * (b[y] - c[y]), right = (a[y] - c[y]) * (b[x] - c[x]);
  const double det = left - right;
  if (std::abs(det) > relative * (std::abs(left) + std::abs(right)) + absolute) return sign_of(det);
  return orient2d_in_integers(a, b, c, axis);
}

}  // namespace hinge::detail::exact
