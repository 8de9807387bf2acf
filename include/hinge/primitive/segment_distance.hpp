// SPDX-License-Identifier: BSD-3-Clause
// Nearest points of points and segments, as the best of a list of candidates.
#pragma once

#include "hinge/core/vec3.hpp"

namespace hinge {

/// Two points, one on each thing, and their squared distance.
struct NearestPair {
  Vec3 first = Vec3::Zero();
  Vec3 second = Vec3::Zero();
  double squared = 0.0;

  static NearestPair of(const Vec3& p, const Vec3& q) noexcept { return {p, q, squared_norm(Vec3(p - q))}; }
  void take_closer(const NearestPair& other) noexcept {
    if (other.squared < squared) *this = other;
  }
  NearestPair swapped() const noexcept { return {second, first, squared}; }
};

/// Point p and segment ab; a degenerate segment is its point.
inline NearestPair nearest(const Vec3& p, const Vec3& a, const Vec3& b) noexcept {
  const Vec3 u = b - a;
  const double along = dot(Vec3(p - a), u), length = dot(u, u);
  if (!(along > 0.0) || !(length > 0.0)) return NearestPair::of(p, a);
  if (along >= length) return NearestPair::of(p, b);
  // From the nearer end, so that a long segment loses no digits at its far end.
  const double t = along / length;
  return NearestPair::of(p, t <= 0.5 ? Vec3(a + u * t) : Vec3(b - u * ((length - along) / length)));
}

/// Segments ab and cd: the four ends against the other segment, and the two inner points where they are not parallel
/// (the common normal of the two lines, where its feet lie inside both).
inline NearestPair nearest(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  NearestPair best = nearest(a, c, d);
  best.take_closer(nearest(b, c, d));
  best.take_closer(nearest(c, a, b).swapped());
  best.take_closer(nearest(d, a, b).swapped());
  const Vec3 u = b - a, v = d - c, w = c - a;
  const Vec3 normal = cross(u, v);
  const double square = dot(normal, normal);
  if (square > 0.0) {
    // Triple products keep their digits where uu vv - uv^2 cancels.
    const double s = dot(cross(w, v), normal) / square, t = dot(cross(w, u), normal) / square;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) {
      const double height = dot(w, normal);
      best.take_closer(NearestPair{a + u * s, c + v * t, height * (height / square)});
    }
  }
  return best;
}

}  // namespace hinge
