// SPDX-License-Identifier: BSD-3-Clause
// Leaf<P>: sixteen primitives of one tree in float SIMD layout, and float proofs that pairs are apart.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

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

/// The leaf of a generic primitive: its box, as midpoint and half extent. Specialisations with a better kernel have the
/// same members.
template <Primitive P>
struct Leaf {
  static constexpr std::size_t floats = 6 * simd::width;

  /// Stores the primitive in a lane. A coordinate x is stored as (x - origin) * scale.
  static void set(float* at, std::size_t lane, const P& p, const Vec3& origin, double scale) noexcept {
    const Aabb box = p.bounds();
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k) * simd::width + lane;
      const double middle = box.middle(k);
      at[i] = static_cast<float>((middle - origin[k]) * scale);
      at[i + 3 * simd::width] =
          float_above(std::max(box.upper[k] - middle, middle - box.lower[k]) * scale * (1.0 + 0x1p-50));
    }
  }

  /// Sixteen primitives of another tree, transformed to this tree's frame.
  class Turned {
   public:
    Turned(const float* other, const LeafTurn& turn) noexcept {
      using simd::Float16;
      constexpr std::size_t n = simd::width;
      for (std::size_t k = 0; k < 3; ++k) {
        Float16 m(turn.translation[k]), h(0.0F);
        for (std::size_t j = 0; j < 3; ++j) {
          m = m + Float16(turn.rotation[4 * j + k]) * Float16(other + j * n);
          h = h + Float16(turn.size[4 * j + k]) * Float16(other + (3 + j) * n);
        }
        m.store(middle_.data() + k * n);
        h.store(half_.data() + k * n);
      }
    }
    /// Returns the lanes that may be near a box.
    simd::Bits near_box(const std::array<float, 3>& middle, const std::array<float, 3>& half,
                        const Nearness& near) const noexcept {
      using simd::Float16;
      constexpr std::size_t n = simd::width;
      simd::Bits lanes = simd::all_bits;
      for (std::size_t k = 0; k < 3; ++k) {
        Float16 reach = Float16(half_.data() + k * n) + Float16(half[k] + near.margin + near.error);
        if (near.other_reach != nullptr) reach = reach + Float16(near.other_reach);
        lanes &= ~less(reach, abs(Float16(middle_.data() + k * n) - Float16(middle[k])));
      }
      return lanes;
    }
    /// Returns the lanes of `lanes` (of this tree's leaf at `own`) that may be near lane k of the transformed leaf.
    simd::Bits near(std::size_t k, const float* own, simd::Bits lanes, const Nearness& near) const noexcept {
      using simd::Float16;
      constexpr std::size_t n = simd::width;
      const float margin = near.margin + near.error + (near.other_reach != nullptr ? near.other_reach[k] : 0.0F);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Float16 reach = Float16(own + (3 + axis) * n) + Float16(half_[axis * n + k] + margin);
        if (near.reach != nullptr) reach = reach + Float16(near.reach);
        lanes &= ~less(reach, abs(Float16(own + axis * n) - Float16(middle_[axis * n + k])));
      }
      return lanes;
    }

    simd::Bits roughly_near(std::size_t k, const float* own, simd::Bits lanes,
                            const Nearness& nearness) const noexcept {
      return near(k, own, lanes, nearness);
    }

   private:
    alignas(64) std::array<float, 3 * simd::width> middle_, half_;
  };
};

/// True when engines keep static trees of this primitive, one per rigid group in the group's frame, instead of blocks
/// of world coordinates. This pays off for extended primitives in large groups. A specialisation of Leaf enables it.
template <class P>
inline constexpr bool UsesStaticBvh = requires {
  requires Leaf<P>::uses_static_bvh;
};

}  // namespace hinge::detail
