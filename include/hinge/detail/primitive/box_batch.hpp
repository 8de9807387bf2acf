// SPDX-License-Identifier: BSD-3-Clause
// Batch<P>: sixteen primitives in float SIMD layout, and proofs that one more primitive is apart from them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Lanes whose box, from `lower` to `upper`, shares a point with the box.
[[gnu::always_inline]] inline simd::Bits lanes_meeting(const std::array<simd::Float16, 3>& lower,
                                                       const std::array<simd::Float16, 3>& upper,
                                                       const FloatBox& box) noexcept {
  const auto axis = [&](std::size_t k) __attribute__((always_inline)) {
    return less_equal(lower[k], simd::Float16(box.upper[k])) & less_equal(simd::Float16(box.lower[k]), upper[k]);
  };
  return axis(0) & axis(1) & axis(2);
}

/// Sixteen primitives in world coordinates, stored in `floats` numbers that the engine owns; the first `coordinates` of
/// them move with the primitive. This version serves every primitive: it stores boxes, and the gap of two boxes bounds
/// the distance from below. hull_batch.hpp has a version for primitives with a small hull, with the same members.
template <Primitive P>
struct Batch {
  static constexpr std::size_t coordinates = 6 * simd::width, floats = coordinates;
  static constexpr bool squared_limits = true;  ///< near() compares with the square of a distance
  /// Float error beyond that of points and boxes (docs/explanation/float_filter.md), in units of 2^-24 of the extent.
  static constexpr double slack = 0.0;

  /// Stores the primitive in a lane. A coordinate x is stored as (x - origin) * scale.
  static void set(float* at, std::size_t lane, const P& p, const Vec3& origin, double scale) noexcept {
    const Aabb box = p.bounds();
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k) * simd::width + lane;
      at[i] = static_cast<float>((box.lower[k] - origin[k]) * scale);
      at[i + 3 * simd::width] = static_cast<float>((box.upper[k] - origin[k]) * scale);
    }
  }

  /// Transforms sixteen primitives from the frames of their groups to the world and stores them. Returns the box around
  /// them.
  static FloatBox place(float* at, const P* local, const std::uint32_t* group, std::span<const Frame> frames,
                        const Vec3& origin, double scale) noexcept {
    for (std::size_t k = 0; k < simd::width; ++k) set(at, k, local[k].placed(frames[group[k]].pose()), origin, scale);
    return hull(at);
  }

  [[gnu::always_inline]] static FloatBox hull(const float* at) noexcept {
    FloatBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = smallest(simd::Float16(at + k * simd::width));
      box.upper[k] = largest(simd::Float16(at + (3 + k) * simd::width));
    }
    return box;
  }

  /// Returns the lanes that share a point with the box.
  [[gnu::always_inline]] static simd::Bits inside(const float* at, const BoxLanes& box) noexcept {
    const auto axis = [&](std::size_t k) __attribute__((always_inline)) {
      return less_equal(simd::Float16(at + k * simd::width), box.upper[k]) &
             less_equal(box.lower[k], simd::Float16(at + (3 + k) * simd::width));
    };
    return axis(0) & axis(1) & axis(2);
  }

  /// All sixteen boxes enlarged by r, for tests against many boxes.
  class Grown {
   public:
    Grown(const float* at, float r) noexcept {
      for (std::size_t k = 0; k < 3; ++k) {
        lower_[k] = simd::Float16(at + k * simd::width) - simd::Float16(r);
        upper_[k] = simd::Float16(at + (3 + k) * simd::width) + simd::Float16(r);
      }
    }
    /// Returns the lanes that share a point with the box, up to rounding.
    [[gnu::always_inline]] simd::Bits meets(const FloatBox& box) const noexcept {
      return lanes_meeting(lower_, upper_, box);
    }

   private:
    std::array<simd::Float16, 3> lower_, upper_;
  };

  /// One primitive, scaled and shifted, against the sixteen of another batch.
  class One {
   public:
    /// at: the first float of the lane; for lane l, pass the batch's address plus l.
    explicit One(const float* at) noexcept {
      for (std::size_t k = 0; k < 3; ++k) {
        lower_[k] = at[k * simd::width];
        upper_[k] = at[(3 + k) * simd::width];
      }
    }
    One(const float* at, float scale, const std::array<float, 3>& shift) noexcept : One(at) {
      for (std::size_t k = 0; k < 3; ++k) {
        lower_[k] = lower_[k] * scale + shift[k];
        upper_[k] = upper_[k] * scale + shift[k];
      }
    }
    /// Returns the lanes that may be within the limit, up to rounding.
    [[gnu::always_inline]] simd::Bits near(const float* to, const simd::Float16& limit) const noexcept {
      using simd::Float16;
      Float16 sum(0.0F);
      for (std::size_t k = 0; k < 3; ++k) {
        const Float16 below = Float16(to + k * simd::width) - Float16(upper_[k]);
        const Float16 above = Float16(lower_[k]) - Float16(to + (3 + k) * simd::width);
        const Float16 gap = max(max(below, above), Float16(0.0F));
        sum = sum + gap * gap;
      }
      // Negated on purpose: overflow and NaN must remain.
      return ~less(limit, sum);
    }

   private:
    std::array<float, 3> lower_, upper_;
  };
};

}  // namespace hinge::detail
