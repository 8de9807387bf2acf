// SPDX-License-Identifier: BSD-3-Clause
// ExactTriangles: two closed triangles in exact integer arithmetic, for pairs that double arithmetic cannot decide.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hinge/core/radius_sum.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/exact/gap.hpp"
#include "hinge/detail/exact/integer.hpp"
#include "hinge/detail/exact/orient.hpp"
#include "hinge/detail/primitive/triangle_corners.hpp"
#include "hinge/detail/primitive/triangle_intersection.hpp"

namespace hinge::detail {

/// All finite coordinates are valid; degenerate triangles are the segment or point that their corners span. Each
/// candidate below is a pair of points whose squared distance is a fraction of integers. Triangles that share a point
/// have a candidate with distance 0 (an edge through a face counts as 0). Disjoint triangles are nearest at two
/// corners, at a corner and the interior of an edge or face, or at the interiors of two edges.
class ExactTriangles {
 public:
  /// `reach`: the threshold to compare with, as finite terms.
  ExactTriangles(const Corners& x, const Corners& y, const RadiusSum& reach = {}) noexcept
      : corners_{x, y}, counts_touching_(reach.counts_touching()) {
    unit_ = exact::common_unit(reach, exact::common_unit(x, exact::common_unit(y)));
    if (unit_ == exact::no_unit) unit_ = 0;
    reach_ = exact::whole(reach, unit_);
  }

  /// Returns true when d is below the radius sum, or equal to it when touching counts.
  bool closer_than_reach() const noexcept {
    bool closer = false;
    visit([&](const Integer& numerator, const Integer& denominator, const auto&) noexcept {
      closer = exact::within(numerator, denominator, reach_, counts_touching_);
      return closer;
    });
    return closer;
  }

  struct Nearest {
    double squared = 0.0;   ///< relative error at most 4 u; 0 only when they share a point; may be infinite
    double distance = 0.0;  ///< its root, accurate also where the square is not a normal double
    Vec3 p, q;  ///< on x and on y, up to rounding of the coordinates; equal when the triangles share a point
  };

  Nearest nearest() const noexcept {
    exact::Scaled least;
    Nearest best;
    bool first = true;
    visit([&](const Integer& numerator, const Integer& denominator, const auto& places) noexcept {
      const exact::Scaled squared = numerator.scaled() / denominator.scaled();
      if (!first && !(squared < least)) return false;
      first = false;
      least = squared;
      places(best);
      return numerator.sign() == 0;
    });
    if (least.mantissa == 0.0) best.q = best.p;
    best.squared = exact::to_double(least, unit_);
    best.distance = sqrt(least).value(unit_);
    return best;
  }

 private:
  using Integer = exact::Integer;
  using Whole = exact::WholePoint;

  Whole between(const Vec3& from, const Vec3& to) const noexcept { return exact::whole_difference(to, from, unit_); }

  /// Calls f(numerator, denominator, places) for every candidate; places(Nearest&) writes the two points. A true result
  /// of f ends the visit.
  template <class Visitor>
  void visit(const Visitor& f) const noexcept {
    if (corner_pairs(f)) return;
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t k = 0; k < 3; ++k)
        if (edges_of_other(f, side, k) || face_of_other(f, side, k) || through_other(f, side, k)) return;
    edge_pairs(f);
  }

  template <class Visitor>
  [[gnu::noinline]] bool corner_pairs(const Visitor& f) const noexcept {
    const Integer one = Integer::of(1.0, 0);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t l = 0; l < 3; ++l) {
        const Whole w = between(corners_[0][k], corners_[1][l]);
        if (f(dot(w, w), one, [&](Nearest& n) noexcept { n.p = corners_[0][k], n.q = corners_[1][l]; })) return true;
      }
    return false;
  }

  /// Writes a point of triangle `side` and a point of the other triangle.
  static void put(Nearest& n, std::size_t side, const Vec3& on_side, const Vec3& on_other) noexcept {
    n.p = side == 0 ? on_side : on_other;
    n.q = side == 0 ? on_other : on_side;
  }

  /// Corner k of one triangle and the interiors of the other's edges: |w x u|^2 / u^2.
  template <class Visitor>
  [[gnu::noinline]] bool edges_of_other(const Visitor& f, std::size_t side, std::size_t k) const noexcept {
    const Corners& other = corners_[1 - side];
    for (std::size_t l = 0; l < 3; ++l) {
      const Vec3 &from = other[l], &to = other[(l + 1) % 3];
      const Whole u = between(from, to), w = between(from, corners_[side][k]);
      const Integer along = dot(w, u), square = dot(u, u);
      if (along.sign() <= 0 || square <= along) continue;
      const Whole across = cross(w, u);
      const auto places = [&](Nearest& n) noexcept {
        put(n, side, corners_[side][k], on_edge(from, to, ratio(along, square)));
      };
      if (f(dot(across, across), square, places)) return true;
    }
    return false;
  }

  /// Corner k and the face of the other triangle: (w . n)^2 / n^2. Only when the foot, at parameters s / n^2 and t /
  /// n^2, is inside.
  template <class Visitor>
  [[gnu::noinline]] bool face_of_other(const Visitor& f, std::size_t side, std::size_t k) const noexcept {
    const Corners& other = corners_[1 - side];
    const Whole u = between(other[0], other[1]), v = between(other[0], other[2]);
    const Whole w = between(other[0], corners_[side][k]), normal = cross(u, v);
    const Integer square = dot(normal, normal), s = triple(w, v, normal), t = triple(u, w, normal);
    if (square.sign() == 0 || s.sign() < 0 || t.sign() < 0 || square < s + t) return false;
    const Integer height = dot(w, normal);
    return f(height * height, square, [&](Nearest& n) noexcept {
      put(n, side, corners_[side][k], on_face(other, ratio(s, square), ratio(t, square)));
    });
  }

  /// The edge that starts at corner k, when it passes through the face of the other triangle.
  template <class Visitor>
  [[gnu::noinline]] bool through_other(const Visitor& f, std::size_t side, std::size_t k) const noexcept {
    const auto& [a, b, c] = corners_[1 - side];
    const Vec3 &p = corners_[side][k], &q = corners_[side][(k + 1) % 3];
    if (exact::orient3d(p, b, c, a) * exact::orient3d(q, b, c, a) >= 0) return false;
    if (!pierces(p, q, corners_[1 - side])) return false;
    const Whole normal = cross(between(a, b), between(a, c));
    const Integer from = dot(between(a, p), normal), to = dot(between(a, q), normal);
    return f(Integer(), Integer::of(1.0, 0),
             [&](Nearest& n) noexcept { n.p = n.q = on_edge(p, q, ratio(from, from - to)); });
  }

  /// The interiors of two edges: (w . n)^2 / n^2, where n is their common normal. Only when both feet are interior.
  template <class Visitor>
  [[gnu::noinline]] void edge_pairs(const Visitor& f) const noexcept {
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t l = 0; l < 3; ++l) {
        const Vec3 &a = corners_[0][k], &b = corners_[0][(k + 1) % 3];
        const Vec3 &c = corners_[1][l], &d = corners_[1][(l + 1) % 3];
        const Whole u = between(a, b), v = between(c, d), w = between(a, c), normal = cross(u, v);
        const Integer square = dot(normal, normal);
        if (square.sign() == 0) continue;
        const Integer s = triple(w, v, normal), t = triple(w, u, normal);
        if (s.sign() < 0 || t.sign() < 0 || square < s || square < t) continue;
        const Integer height = dot(w, normal);
        const auto places = [&](Nearest& n) noexcept {
          n.p = on_edge(a, b, ratio(s, square));
          n.q = on_edge(c, d, ratio(t, square));
        };
        if (f(height * height, square, places)) return;
      }
  }

  std::array<Corners, 2> corners_;
  int unit_ = 0;
  Integer reach_;
  bool counts_touching_ = false;
};

// Out of line: stack frames with Integers are large, and callers rarely need these functions.

[[gnu::cold, gnu::noinline]] inline ExactTriangles::Nearest nearest_in_integers(const Corners& x,
                                                                                const Corners& y) noexcept {
  return ExactTriangles(x, y).nearest();
}

[[gnu::cold, gnu::noinline]] inline bool closer_in_integers(const Corners& x, const Corners& y,
                                                            const RadiusSum& reach) noexcept {
  return ExactTriangles(x, y, reach).closer_than_reach();
}

}  // namespace hinge::detail
