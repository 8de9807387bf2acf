// SPDX-License-Identifier: BSD-3-Clause
// ExactTriangles: two closed triangles in whole numbers, for pairs that double arithmetic leaves open.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hinge/core/vec3.hpp"
#include "hinge/exact/integer.hpp"
#include "hinge/exact/orient.hpp"
#include "hinge/primitive/triangle_corners.hpp"

namespace hinge::detail {

/// Any finite coordinates; degenerate triangles are the segments or points their corners span. Triangles that meet do
/// so at one of the places below with distance 0 (an edge through a face counts 0); disjoint ones are nearest at two
/// corners, at a corner and the inside of an edge or face, or at the insides of two edges. The squared distance of each
/// is a fraction of whole numbers.
class ExactTriangles {
 public:
  /// `m`: a finite length >= 0 to compare with.
  ExactTriangles(const Corners& x, const Corners& y, double m = 0.0) noexcept : corners_{x, y} {
    unit_ = exact::common_unit(x, exact::common_unit(y, exact::unit_exponent(m, exact::no_unit)));
    if (unit_ == exact::no_unit) unit_ = 0;
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t k = 0; k < 3; ++k)
        points_[side][k] = exact::whole_difference(corners_[side][k], corners_[0][0], unit_);
    m_ = Integer::of(m, unit_);
  }

  /// d < m.
  bool closer_than_m() const noexcept {
    const Integer square = m_ * m_;
    bool closer = false;
    visit([&](const Integer& numerator, const Integer& denominator, const auto&) noexcept {
      closer = numerator < square * denominator;
      return closer;
    });
    return closer;
  }

  struct Nearest {
    double squared = 0.0;   ///< within 4 half ulps; 0 only when they meet; infinite above the largest double
    double distance = 0.0;  ///< its root, right also where the square is no normal double
    Vec3 p, q;              ///< on x and on y, up to rounding of their coordinates; the same point when they meet
  };

  Nearest nearest() const noexcept {
    constexpr double smallest = 0x1p-1074;
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
    if (least.mantissa == 0.0)
      best.q = best.p;
    else
      best.squared = std::max(least.value(2 * unit_), smallest);
    // The exponent made even before the root halves it.
    const int odd = least.exponent & 1;
    best.distance = std::ldexp(std::sqrt(std::ldexp(least.mantissa, odd)), (least.exponent - odd) / 2 + unit_);
    return best;
  }

 private:
  using Integer = exact::Integer;
  using Whole = exact::WholePoint;

  static double share(const Integer& part, const Integer& of) noexcept {
    return part.sign() == 0 ? 0.0 : (part.scaled() / of.scaled()).value();
  }

  /// f(numerator, denominator, places) for every place; places(Nearest&) writes the two points. f ends it with true.
  template <class Visitor>
  void visit(const Visitor& f) const noexcept {
    if (corner_pairs(f)) return;
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t k = 0; k < 3; ++k)
        if (edges_of_other(f, side, k) || face_of_other(f, side, k) || through_other(f, side, k)) return;
    edge_pairs(f);
  }

  template <class Visitor>
  bool corner_pairs(const Visitor& f) const noexcept {
    const Integer one = Integer::of(1.0, 0);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t l = 0; l < 3; ++l) {
        const Whole w = points_[1][l] - points_[0][k];
        if (f(dot(w, w), one, [&](Nearest& n) noexcept { n.p = corners_[0][k], n.q = corners_[1][l]; })) return true;
      }
    return false;
  }

  /// Writes a point of triangle `side` and one of the other.
  static void put(Nearest& n, std::size_t side, const Vec3& on_side, const Vec3& on_other) noexcept {
    n.p = side == 0 ? on_side : on_other;
    n.q = side == 0 ? on_other : on_side;
  }

  /// Corner k of a triangle and the insides of the other's edges: |w x u|^2 / u^2.
  template <class Visitor>
  bool edges_of_other(const Visitor& f, std::size_t side, std::size_t k) const noexcept {
    const std::size_t other = 1 - side;
    for (std::size_t l = 0; l < 3; ++l) {
      const std::size_t next = (l + 1) % 3;
      const Whole u = points_[other][next] - points_[other][l], w = points_[side][k] - points_[other][l];
      const Integer along = dot(w, u), square = dot(u, u);
      if (along.sign() <= 0 || square <= along) continue;
      const Whole across = cross(w, u);
      const auto places = [&](Nearest& n) noexcept {
        put(n, side, corners_[side][k], on_edge(corners_[other][l], corners_[other][next], share(along, square)));
      };
      if (f(dot(across, across), square, places)) return true;
    }
    return false;
  }

  /// Corner k and the other's face: (w . n)^2 / n^2 where the foot, at (s, t) n^2 along the edges, is inside.
  template <class Visitor>
  bool face_of_other(const Visitor& f, std::size_t side, std::size_t k) const noexcept {
    const std::size_t other = 1 - side;
    const auto& [a, b, c] = points_[other];
    const Whole u = b - a, v = c - a, w = points_[side][k] - a, normal = cross(u, v);
    const Integer square = dot(normal, normal), s = dot(cross(w, v), normal), t = dot(cross(u, w), normal);
    if (square.sign() == 0 || s.sign() < 0 || t.sign() < 0 || square < s + t) return false;
    const Integer height = dot(w, normal);
    return f(height * height, square, [&](Nearest& n) noexcept {
      put(n, side, corners_[side][k], on_face(corners_[other], share(s, square), share(t, square)));
    });
  }

  /// The edge that starts at corner k, through the other's face.
  template <class Visitor>
  bool through_other(const Visitor& f, std::size_t side, std::size_t k) const noexcept {
    const auto& [a, b, c] = points_[1 - side];
    const Whole &p = points_[side][k], &q = points_[side][(k + 1) % 3], normal = cross(b - a, c - a);
    const Integer from = dot(p - a, normal), to = dot(q - a, normal);
    if (from.sign() * to.sign() >= 0) return false;
    const Whole along = q - p, pa = a - p, pb = b - p, pc = c - p;
    if (!same_side(dot(cross(pa, pb), along).sign(), dot(cross(pb, pc), along).sign(),
                   dot(cross(pc, pa), along).sign()))
      return false;
    return f(Integer(), Integer::of(1.0, 0), [&](Nearest& n) noexcept {
      n.p = n.q = on_edge(corners_[side][k], corners_[side][(k + 1) % 3], share(from, from - to));
    });
  }

  /// The insides of two edges: (w . n)^2 / n^2, n their common normal, where its feet s and t are inside both.
  template <class Visitor>
  void edge_pairs(const Visitor& f) const noexcept {
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t l = 0; l < 3; ++l) {
        const std::size_t k1 = (k + 1) % 3, l1 = (l + 1) % 3;
        const Whole u = points_[0][k1] - points_[0][k], v = points_[1][l1] - points_[1][l];
        const Whole w = points_[1][l] - points_[0][k], normal = cross(u, v);
        const Integer square = dot(normal, normal);
        if (square.sign() == 0) continue;
        const Integer s = dot(cross(w, v), normal), t = dot(cross(w, u), normal);
        if (s.sign() < 0 || t.sign() < 0 || square < s || square < t) continue;
        const Integer height = dot(w, normal);
        const auto places = [&](Nearest& n) noexcept {
          n.p = on_edge(corners_[0][k], corners_[0][k1], share(s, square));
          n.q = on_edge(corners_[1][l], corners_[1][l1], share(t, square));
        };
        if (f(height * height, square, places)) return;
      }
  }

  std::array<Corners, 2> corners_;
  std::array<std::array<Whole, 3>, 2> points_;  // from the first corner, in units of 2^unit_
  int unit_ = 0;
  Integer m_;
};

// Out of line: whole numbers take some 40 KiB of stack, which nobody else should have on theirs, or twice.

[[gnu::cold, gnu::noinline]] inline ExactTriangles::Nearest nearest_in_integers(const Corners& x,
                                                                                const Corners& y) noexcept {
  return ExactTriangles(x, y).nearest();
}

[[gnu::cold, gnu::noinline]] inline bool closer_in_integers(const Corners& x, const Corners& y, double m) noexcept {
  return ExactTriangles(x, y, m).closer_than_m();
}

}  // namespace hinge::detail
