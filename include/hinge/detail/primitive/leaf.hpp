// SPDX-License-Identifier: BSD-3-Clause
// Leaf<P>: sixteen primitives of one tree side by side in float, and what floats can prove about two such leaves.
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

/// How the coordinates of another tree are brought into this one's: x -> rotation x + translation.
struct LeafTurn {
  const std::array<float, 12>& rotation;  ///< column by column, each with a spare entry
  const std::array<float, 12>& size;      ///< its magnitudes, rounded up
  const std::array<float, 4>& translation;
};

/// What counts as near: distance <= margin + reach of both. `error` bounds how far one coordinate of a turned
/// primitive, projected on an axis of length 1, may be off.
struct Nearness {
  float margin = 0.0F;
  float error = 0.0F;
  const float* reach = nullptr;        ///< of the sixteen; null: all 0
  const float* other_reach = nullptr;  ///< of the other sixteen
};

/// The leaf for any primitive: boxes. A specialisation for a primitive with a better kernel offers the same members.
template <Primitive P>
struct Leaf {
  static constexpr std::size_t floats = 6 * simd::width;

  /// Stores the primitive in a lane; (x - origin) * scale is what is kept of a coordinate x.
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

  /// Sixteen of another tree, brought into this one's frame.
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
    /// Lanes of it that may be near a box.
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
    /// Of `lanes` of this tree's sixteen (at `own`), those that may be near lane k of the other's.
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

/// Do engines keep this primitive in trees of its rigid groups, in their frames, rather than in placed blocks? It pays
/// where primitives have an extent and groups many of them. A specialisation of Leaf says so.
template <class P>
inline constexpr bool UsesStaticBvh = requires {
  requires Leaf<P>::uses_static_bvh;
};

}  // namespace hinge::detail
