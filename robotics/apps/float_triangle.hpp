// SPDX-License-Identifier: BSD-3-Clause
// Decisions about triangles in single precision without error bounds, as many programs make them. Only dial --extremes
// uses them, to count what they get wrong.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hinge/core/vec3.hpp"
#include "hinge/primitive/triangle.hpp"

namespace robocd {

using FloatPoint = std::array<float, 3>;
using FloatTriangle = std::array<FloatPoint, 3>;

/// An axis-parallel box; empty at first.
struct FloatBox {
  FloatPoint lower{INFINITY, INFINITY, INFINITY}, upper{-INFINITY, -INFINITY, -INFINITY};

  void add(const FloatBox& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], other.lower[k]);
      upper[k] = std::max(upper[k], other.upper[k]);
    }
  }
  /// Returns true if the boxes are further apart than `reach` along an axis.
  bool apart(const FloatBox& other, float reach) const {
    bool any = false;
    for (std::size_t k = 0; k < 3; ++k) any |= lower[k] > other.upper[k] + reach || other.lower[k] > upper[k] + reach;
    return any;
  }
};

inline FloatBox box_of(const FloatTriangle& t) {
  FloatBox box;
  for (const FloatPoint& x : t) box.add({x, x});
  return box;
}

inline FloatPoint to_float(const hinge::Vec3& x) {
  return {static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])};
}

namespace single {

inline FloatPoint minus(const FloatPoint& a, const FloatPoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline FloatPoint along(const FloatPoint& a, const FloatPoint& d, float t) {
  return {a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2]};
}
inline float dot(const FloatPoint& a, const FloatPoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline FloatPoint cross(const FloatPoint& a, const FloatPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline float squared(const FloatPoint& a) { return dot(a, a); }

/// Squared distance of two segments (Ericson 2005, Real-Time Collision Detection, section 5.1.9).
inline float segments(const FloatPoint& p1, const FloatPoint& q1, const FloatPoint& p2, const FloatPoint& q2) {
  const FloatPoint d1 = minus(q1, p1), d2 = minus(q2, p2), r = minus(p1, p2);
  const float a = squared(d1), e = squared(d2), f = dot(d2, r);
  const auto clamp = [](float t) { return std::clamp(t, 0.0F, 1.0F); };
  float s = 0.0F, t = 0.0F;
  if (a > 0.0F && e > 0.0F) {
    const float b = dot(d1, d2), c = dot(d1, r), denominator = a * e - b * b;
    if (denominator > 0.0F) s = clamp((b * f - c * e) / denominator);
    t = (b * s + f) / e;
    if (t < 0.0F || t > 1.0F) {
      t = clamp(t);
      s = clamp((b * t - c) / a);
    }
  } else if (a > 0.0F) {
    s = clamp(-dot(d1, r) / a);
  } else if (e > 0.0F) {
    t = clamp(f / e);
  }
  return squared(minus(along(p1, d1, s), along(p2, d2, t)));
}

/// Squared distance of a point from the inside of a triangle, or infinity if its foot is outside.
inline float face(const FloatPoint& p, const FloatTriangle& t) {
  const FloatPoint normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  const float area = squared(normal);
  for (std::size_t k = 0; k < 3; ++k)
    if (dot(cross(minus(t[(k + 1) % 3], t[k]), minus(p, t[k])), normal) < 0.0F) return INFINITY;
  const float height = dot(normal, minus(p, t[0]));
  return area > 0.0F ? height * height / area : INFINITY;
}

/// True if the segment crosses the triangle (Moeller & Trumbore 1997).
inline bool crosses(const FloatPoint& p, const FloatPoint& q, const FloatTriangle& t) {
  const FloatPoint d = minus(q, p), e1 = minus(t[1], t[0]), e2 = minus(t[2], t[0]), h = cross(d, e2);
  const float determinant = dot(e1, h);
  if (determinant == 0.0F) return false;
  const FloatPoint s = minus(p, t[0]), c = cross(s, e1);
  const float u = dot(s, h) / determinant, v = dot(d, c) / determinant, w = dot(e2, c) / determinant;
  return u >= 0.0F && v >= 0.0F && u + v <= 1.0F && w >= 0.0F && w <= 1.0F;
}

}  // namespace single

/// Returns true if the triangles meet or are closer than m, by the numbers that single precision gives.
inline bool closer_in_float(const FloatTriangle& x, const FloatTriangle& y, float m) {
  float least = INFINITY;
  for (std::size_t k = 0; k < 3; ++k) {
    const FloatPoint &a = x[k], &b = x[(k + 1) % 3], &c = y[k], &d = y[(k + 1) % 3];
    if (single::crosses(a, b, y) || single::crosses(c, d, x)) return true;
    least = std::min({least, single::face(a, y), single::face(c, x)});
    for (std::size_t l = 0; l < 3; ++l) least = std::min(least, single::segments(a, b, y[l], y[(l + 1) % 3]));
  }
  return least == 0.0F || least < m * m;
}

}  // namespace robocd
