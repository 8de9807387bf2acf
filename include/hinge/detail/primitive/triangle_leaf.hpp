// SPDX-License-Identifier: BSD-3-Clause
// TriangleLeaf: sixteen triangles of a static tree in float SIMD layout. Separating axes prove that pairs are apart.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// True when engine/simd keeps static trees of this primitive, one per rigid group in the group's frame, instead of
/// blocks of world coordinates: for triangles, which are extended and come in large groups.
template <class P>
concept UsesStaticBvh = FillsHull<P> && HasSharpHull<P> && hull_size<P>
== 3;

/// A rigid transform from the frame of another tree to this tree's frame: x -> rotation x + translation.
struct LeafTurn {
  const std::array<float, 12>& rotation;  ///< column by column, each padded to four entries
  const std::array<float, 12>& size;      ///< magnitudes of the rotation's entries, rounded up
  const std::array<float, 4>& translation;
};

/// A pair is near when distance <= margin + the sum of both threshold radii. `error` bounds the error of a transformed
/// coordinate, projected on an axis of length 1.
struct Nearness {
  float margin = 0.0F;
  float error = 0.0F;
  const float* reach = nullptr;        ///< threshold radii of this leaf's lanes; null: all 0
  const float* other_reach = nullptr;  ///< threshold radii of the other leaf's lanes; null: all 0
};

template <class T>
struct Axis {
  T x, y, z;
};

template <class T>
[[gnu::always_inline]] inline Axis<T> cross_axis(const Axis<T>& a, const Axis<T>& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
[[gnu::always_inline]] inline Axis<T> difference(const Axis<T>& a, const Axis<T>& b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
[[gnu::always_inline]] inline T along(const Axis<T>& n, const Axis<T>& p) noexcept {
  return n.x * p.x + n.y * p.y + n.z * p.z;
}

/// Disjoint projections on any axis prove that two triangles are disjoint, even when the axis itself is inaccurate.
/// Only the rounding of the projections matters. The tests use the normal of the single triangle, the normals of the
/// sixteen, and the cross products of edges, while undecided lanes remain. The functions are flattened, because
/// compilers otherwise call small lambdas and pass lanes through memory.
struct TriangleLeaf {
  using Float16 = simd::Float16;
  using Lanes3 = Axis<Float16>;
  using One3 = Axis<float>;
  static constexpr std::size_t n = simd::width;
  static constexpr std::size_t floats = 9 * n;  ///< x, y, z of a, then of b, then of c

  /// Stores a triangle in a lane. A coordinate x is stored as (x - origin) * scale.
  template <UsesStaticBvh P>
  static void set(float* at, std::size_t lane, const P& p, const Vec3& origin, double scale) noexcept {
    std::size_t place = lane;
    for (const Vec3& corner : p.hull())
      for (int k = 0; k < 3; ++k, place += n) at[place] = static_cast<float>((corner[k] - origin[k]) * scale);
  }

  static Lanes3 corner(const float* at, std::size_t c) noexcept {
    return {Float16(at + 3 * c * n), Float16(at + (3 * c + 1) * n), Float16(at + (3 * c + 2) * n)};
  }

  /// Returns the largest projection of each triangle on an axis.
  [[gnu::always_inline]] static Float16 top(const float* at, const One3& axis) noexcept {
    const Lanes3 wide{axis.x, axis.y, axis.z};
    return max(max(along(wide, corner(at, 0)), along(wide, corner(at, 1))), along(wide, corner(at, 2)));
  }

  /// Sixteen triangles of another tree, transformed to this tree's frame.
  class Turned {
   public:
    [[gnu::flatten]] Turned(const float* other, const LeafTurn& turn) noexcept {
      const auto& r = turn.rotation;
      for (std::size_t c = 0; c < 3; ++c) {
        const Lanes3 p = corner(other, c);
        for (std::size_t k = 0; k < 3; ++k)
          (Float16(r[k]) * p.x + Float16(r[4 + k]) * p.y + Float16(r[8 + k]) * p.z + Float16(turn.translation[k]))
              .store(at_.data() + (3 * c + k) * n);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const Float16 a(at_.data() + k * n), b(at_.data() + (3 + k) * n), c(at_.data() + (6 + k) * n);
        min(min(a, b), c).store(lower_.data() + k * n);
        max(max(a, b), c).store(upper_.data() + k * n);
      }
    }

    const float* coordinates() const noexcept { return at_.data(); }

    /// Returns the lanes that may be near a box.
    [[gnu::flatten]] simd::Bits near_box(const std::array<float, 3>& middle, const std::array<float, 3>& half,
                                         const Nearness& near) const noexcept {
      simd::Bits lanes = simd::all_bits;
      const float slack = near.margin + near.error;
      for (std::size_t k = 0; k < 3; ++k) {
        Float16 lower(lower_.data() + k * n), upper(upper_.data() + k * n);
        if (near.other_reach != nullptr) {
          lower = lower - Float16(near.other_reach);
          upper = upper + Float16(near.other_reach);
        }
        lanes &=
            ~less(Float16(middle[k] + (half[k] + slack)), lower) & ~less(upper, Float16(middle[k] - (half[k] + slack)));
      }
      return lanes;
    }

    /// Returns the lanes of `lanes` (of this tree's leaf at `own`) that may be near lane k of the transformed leaf.
    [[gnu::flatten]] simd::Bits near(std::size_t k, const float* own, simd::Bits lanes,
                                     const Nearness& near) const noexcept {
      if (near.reach == nullptr && near.other_reach == nullptr && near.margin <= 0.0F)
        return not_apart<false, true>(k, own, lanes, near);
      return not_apart<true, true>(k, own, lanes, near);
    }
    /// The same with fewer axes, for pairs that a distance bound tests next.
    [[gnu::flatten]] simd::Bits roughly_near(std::size_t k, const float* own, simd::Bits lanes,
                                             const Nearness& near) const noexcept {
      return not_apart<true, false>(k, own, lanes, near);
    }

   private:
    /// Returns the lanes without a proof: their gap along the axis does not exceed the rounding error and, with Grown,
    /// the margin.
    template <bool Grown>
    [[gnu::always_inline]] static simd::Bits unproved(const Lanes3& axis, const Float16& gap, const Nearness& near,
                                                      const Float16& margin) noexcept {
      // Upper bound of the underflow error in products of floats.
      constexpr float underflow = 1e-37F;
      const Float16 rounding = (abs(axis.x) + abs(axis.y) + abs(axis.z)) * Float16(near.error) + Float16(underflow);
      if constexpr (Grown) {
        const Float16 rest = gap - rounding;
        const Float16 square = margin * margin * (axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
        return ~less(Float16(0.0F), rest) | ~less(square + Float16(underflow), rest * rest);
      } else {
        return ~less(rounding, gap);
      }
    }

    template <bool Grown, bool Edges>
    [[gnu::always_inline]] simd::Bits not_apart(std::size_t k, const float* own, simd::Bits lanes,
                                                const Nearness& near) const noexcept {
      const auto one = [&](std::size_t c) {
        return One3{at_[3 * c * n + k], at_[(3 * c + 1) * n + k], at_[(3 * c + 2) * n + k]};
      };
      const One3 p = one(0), q = one(1), r = one(2);
      const Lanes3 a = corner(own, 0), b = corner(own, 1), c = corner(own, 2);
      Float16 margin(near.margin);
      if constexpr (Grown) {
        if (near.reach != nullptr) margin = margin + Float16(near.reach);
        if (near.other_reach != nullptr) margin = margin + Float16(near.other_reach[k]);
        margin = max(margin, Float16(0.0F)) * Float16(1.0F + 0x1p-20F);  // rounding of sums and squares
      }
      // Axes of the bounding boxes.
      const Float16 zero(0.0F), error(near.error);
      const auto box_gap = [&](const Float16& x, const Float16& y, const Float16& z, std::size_t axis) {
        const Float16 above = min(min(x, y), z) - (Float16(upper_[axis * n + k]) + error);
        return max(max(above, (Float16(lower_[axis * n + k]) - error) - max(max(x, y), z)), zero);
      };
      const Float16 gap_x = box_gap(a.x, b.x, c.x, 0), gap_y = box_gap(a.y, b.y, c.y, 1),
                    gap_z = box_gap(a.z, b.z, c.z, 2);
      if constexpr (Grown)
        lanes &= ~less(margin * margin, gap_x * gap_x + gap_y * gap_y + gap_z * gap_z);
      else
        lanes &= ~less(zero, max(max(gap_x, gap_y), gap_z));
      if (lanes == 0) return 0;
      // Normal of the single triangle.
      {
        const One3 axis = cross_axis(difference(q, p), difference(r, p));
        const float u = along(axis, p), v = along(axis, q), w = along(axis, r);
        const Lanes3 wide{axis.x, axis.y, axis.z};
        const Float16 s = along(wide, a), t = along(wide, b), o = along(wide, c);
        const Float16 gap = max(min(min(s, t), o) - Float16(std::max(std::max(u, v), w)),
                                Float16(std::min(std::min(u, v), w)) - max(max(s, t), o));
        lanes &= unproved<Grown>(wide, gap, near, margin);
        if (lanes == 0) return 0;
      }
      const Lanes3 P{p.x, p.y, p.z}, Q{q.x, q.y, q.z}, R{r.x, r.y, r.z};
      const auto try_axis = [&](const Lanes3& axis) __attribute__((always_inline)) {
        const Float16 s = along(axis, a), t = along(axis, b), o = along(axis, c);
        const Float16 u = along(axis, P), v = along(axis, Q), w = along(axis, R);
        const Float16 gap = max(min(min(s, t), o) - max(max(u, v), w), min(min(u, v), w) - max(max(s, t), o));
        lanes &= unproved<Grown>(axis, gap, near, margin);
      };
      // Normals of the sixteen triangles.
      const Lanes3 ab = difference(b, a), bc = difference(c, b), ca = difference(a, c);
      try_axis(cross_axis(ab, bc));
      if constexpr (Grown) {
        // Axis between the centroids. It separates many pairs whose nearest points are corners, and degenerate
        // triangles.
        const Float16 third(1.0F / 3.0F);
        try_axis({(a.x + b.x + c.x - P.x - Q.x - R.x) * third, (a.y + b.y + c.y - P.y - Q.y - R.y) * third,
                  (a.z + b.z + c.z - P.z - Q.z - R.z) * third});
      }
      if (!Edges || lanes == 0) return lanes;
      for (const Lanes3& edge : {difference(Q, P), difference(R, Q), difference(P, R)}) {
        try_axis(cross_axis(edge, ab));
        try_axis(cross_axis(edge, bc));
        try_axis(cross_axis(edge, ca));
        if (lanes == 0) return 0;
      }
      return lanes;
    }

    alignas(64) std::array<float, 9 * n> at_;
    alignas(64) std::array<float, 3 * n> lower_, upper_;
  };
};

}  // namespace hinge::detail
