// SPDX-License-Identifier: BSD-3-Clause
// TrianglePairs: sixteen pairs of triangles of two trees, with lower and upper float bounds of their distances.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "hinge/detail/primitive/triangle_leaf.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// Lower and upper bounds of sixteen distances, and the differences of the points that give the upper bounds.
struct Bounds16 {
  alignas(64) std::array<float, simd::width> lower, upper, x, y, z;
};

/// An upper bound is the distance of two points on the triangles: the best of nine edge pairs and six pairs of corner
/// and face. A lower bound is the gap along the line through these points, so rounding in the search cannot invalidate
/// a bound.
class TrianglePairs {
 public:
  /// Stores lane i of the leaf at `own` and lane k of another leaf, transformed to its frame. error: see Nearness.
  void set(std::size_t place, const float* own, std::size_t i, const TriangleLeaf::Turned& turned, std::size_t k,
           float error) noexcept {
    for (std::size_t c = 0; c < 9; ++c) {
      at_[c * n + place] = own[c * n + i];
      at_[(9 + c) * n + place] = turned.coordinates()[c * n + k];
    }
    error_[place] = error;
  }

  [[gnu::flatten]] void bound(Bounds16& bounds) const noexcept {
    const Corners3 a = corners(0), b = corners(3);
    Best best;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) best.try_edges(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]);
    for (std::size_t i = 0; i < 3; ++i) {
      best.try_face(a[i], b, false);
      best.try_face(b[i], a, true);
    }
    const Float16 error(error_.data());
    const Lanes3 axis = difference(best.q, best.p);
    axis.x.store(bounds.x.data());
    axis.y.store(bounds.y.data());
    axis.z.store(bounds.z.data());
    const Float16 square = along(axis, axis), length = root(square);
    (length * Float16(1.0F + 0x1p-20F) + error * Float16(4.0F)).store(bounds.upper.data());
    const auto project = [&](const Corners3& c) __attribute__((always_inline)) {
      return std::array<Float16, 3>{along(axis, c[0]), along(axis, c[1]), along(axis, c[2])};
    };
    const auto s = project(a), t = project(b);
    const Float16 gap =
        min(min(t[0], t[1]), t[2]) - max(max(s[0], s[1]), s[2]) - (abs(axis.x) + abs(axis.y) + abs(axis.z)) * error;
    // Divide by the length, enlarged by its rounding error.
    const Float16 lower = max(gap, Float16(0.0F)) / (length * Float16(1.0F + 0x1p-20F) + Float16(1e-18F));
    // A NaN gap proves nothing: use 0.
    choose_less(Float16(0.0F), lower, lower, Float16(0.0F)).store(bounds.lower.data());
  }

 private:
  using Float16 = simd::Float16;
  using Lanes3 = TriangleLeaf::Lanes3;
  using Corners3 = std::array<Lanes3, 3>;
  static constexpr std::size_t n = simd::width;

  Corners3 corners(std::size_t first) const noexcept {
    const auto corner = [&](std::size_t c) { return TriangleLeaf::corner(at_.data(), c); };
    return {corner(first), corner(first + 1), corner(first + 2)};
  }

  /// Returns the square root per lane. Compilers vectorise the loop.
  static Float16 root(const Float16& squares) noexcept {
    alignas(64) std::array<float, n> x;
    squares.store(x.data());
    for (float& each : x) each = __builtin_sqrtf(each);
    return Float16(x.data());
  }

  /// Returns x plus a tiny value, so that no quotient is NaN.
  static Float16 divisor(const Float16& x) noexcept { return x + Float16(1e-30F); }
  static Float16 clamped(const Float16& x) noexcept { return max(min(x, Float16(1.0F)), Float16(0.0F)); }
  static Lanes3 on_line(const Lanes3& from, const Lanes3& by, const Float16& share) noexcept {
    return {from.x + by.x * share, from.y + by.y * share, from.z + by.z * share};
  }

  /// The nearest points so far, p on triangle a and q on triangle b.
  struct Best {
    Lanes3 p{Float16(0.0F), Float16(0.0F), Float16(0.0F)}, q = p;
    Float16 square{std::numeric_limits<float>::infinity()};

    [[gnu::always_inline]] void take(const Lanes3& x, const Lanes3& y) noexcept {
      const Lanes3 d = difference(y, x);
      const Float16 s = along(d, d);
      const auto choose = [&](const Float16& a, const Float16& b) __attribute__((always_inline)) {
        return choose_less(s, square, a, b);
      };
      p = {choose(x.x, p.x), choose(x.y, p.y), choose(x.z, p.z)};
      q = {choose(y.x, q.x), choose(y.y, q.y), choose(y.z, q.z)};
      square = min(s, square);
    }

    /// Tries the nearest points of two edges. The points lie on the edges for any parameters; rounding only makes them
    /// less near.
    [[gnu::always_inline]] void try_edges(const Lanes3& a, const Lanes3& a2, const Lanes3& b,
                                          const Lanes3& b2) noexcept {
      const Lanes3 u = difference(a2, a), v = difference(b2, b), r = difference(a, b);
      const Float16 uu = along(u, u), vv = along(v, v), uv = along(u, v), ur = along(u, r), vr = along(v, r);
      Float16 s = clamped((uv * vr - ur * vv) / divisor(max(uu * vv - uv * uv, Float16(0.0F))));
      const Float16 t = clamped((uv * s + vr) / divisor(vv));
      s = clamped((uv * t - ur) / divisor(uu));
      take(on_line(a, u, s), on_line(b, v, t));
    }

    /// Tries a corner and the foot of its perpendicular on a face, clamped to the triangle.
    [[gnu::always_inline]] void try_face(const Lanes3& corner, const Corners3& face, bool corner_is_b) noexcept {
      const Lanes3 u = difference(face[1], face[0]), v = difference(face[2], face[0]), w = difference(corner, face[0]);
      const Lanes3 normal = cross_axis(u, v);
      const Float16 area = along(normal, normal);
      const Float16 s = clamped(along(cross_axis(w, v), normal) / divisor(area));
      const Float16 t = min(clamped(along(cross_axis(u, w), normal) / divisor(area)), Float16(1.0F) - s);
      const Lanes3 foot{face[0].x + u.x * s + v.x * t, face[0].y + u.y * s + v.y * t, face[0].z + u.z * s + v.z * t};
      if (corner_is_b)
        take(foot, corner);
      else
        take(corner, foot);
    }
  };

  alignas(64) std::array<float, 18 * n> at_{};
  alignas(64) std::array<float, n> error_{};
};

}  // namespace hinge::detail
