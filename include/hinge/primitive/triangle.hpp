// SPDX-License-Identifier: BSD-3-Clause
// Triangle: a closed triangle in space; a degenerate one is the segment or point its vertices span.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/primitive/segment_distance.hpp"

namespace hinge {

struct Triangle {
  Vec3 a = Vec3::Zero();
  Vec3 b = Vec3::Zero();
  Vec3 c = Vec3::Zero();

  Triangle placed(const Pose& pose) const noexcept { return {pose * a, pose * b, pose * c}; }
  Aabb bounds() const noexcept { return Aabb(a).extend(b).extend(c); }

  friend double squared_distance(const Triangle& p, const Triangle& q) noexcept { return nearest_points(p, q).squared; }
  friend std::pair<Vec3, Vec3> closest_points(const Triangle& p, const Triangle& q) noexcept {
    const NearestPair pair = nearest_points(p, q);
    return {pair.first, pair.second};
  }

 private:
  using Vertices = std::array<Vec3, 3>;
  Vertices vertices() const noexcept { return {a, b, c}; }

  /// Twice the signed volume spanned by four points, relative to the last: which side of abc is d on?
  static double side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
    return dot(Vec3(a - d), cross(Vec3(b - d), Vec3(c - d)));
  }

  /// Does the open segment pq pass through the triangle, away from its plane's degenerate cases? Touching and coplanar
  /// contact are left to the distances of features, which are 0 there up to rounding.
  static bool crosses(const Vec3& p, const Vec3& q, const Vertices& t, Vec3& at) noexcept {
    const double sp = side(t[0], t[1], t[2], p), sq = side(t[0], t[1], t[2], q);
    if (!((sp > 0.0 && sq < 0.0) || (sp < 0.0 && sq > 0.0))) return false;
    const double u = side(p, q, t[0], t[1]), v = side(p, q, t[1], t[2]), w = side(p, q, t[2], t[0]);
    if (!((u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0))) return false;
    at = p + (q - p) * (sp / (sp - sq));
    return true;
  }

  /// Disjoint triangles are nearest at two edges, or at a vertex and a face; intersecting ones have an edge of one
  /// through the other.
  static NearestPair nearest_points(const Triangle& p, const Triangle& q) noexcept {
    const Vertices x = p.vertices(), y = q.vertices();
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 at;
      if (crosses(x[k], x[(k + 1) % 3], y, at) || crosses(y[k], y[(k + 1) % 3], x, at)) return {at, at, 0.0};
    }
    NearestPair best = nearest_on_triangle(x[0], y[0], y[1], y[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      if (k > 0) best.take_closer(nearest_on_triangle(x[k], y[0], y[1], y[2]));
      best.take_closer(nearest_on_triangle(y[k], x[0], x[1], x[2]).swapped());
      for (std::size_t l = 0; l < 3; ++l) best.take_closer(nearest(x[k], x[(k + 1) % 3], y[l], y[(l + 1) % 3]));
    }
    return best;
  }
};

static_assert(HasClosestPoints<Triangle>);

}  // namespace hinge
