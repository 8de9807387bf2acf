// SPDX-License-Identifier: BSD-3-Clause
// Batch<P>: sixteen primitives in float SIMD layout, and lower bounds of their distances to one more primitive.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/kinematics/compose_frames.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/primitive/point.hpp"

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

/// Sixteen primitives in world coordinates, stored in `floats` numbers that the engine owns. The generic version stores
/// their boxes, so the squared gap of boxes bounds the squared distance from below. Specialisations with a better
/// kernel have the same members. They also have `turn` when a rotation of the stored coordinates gives the rotated
/// primitive.
template <Primitive P>
struct Batch {
  static constexpr std::size_t floats = 6 * simd::width;

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

  /// One primitive, scaled and shifted, against the sixteen of another batch. The results are lower bounds of the
  /// squared distances, up to rounding.
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
    [[gnu::always_inline]] simd::Float16 squared_distances(const float* to) const noexcept {
      using simd::Float16;
      Float16 sum(0.0F);
      for (std::size_t k = 0; k < 3; ++k) {
        const Float16 below = Float16(to + k * simd::width) - Float16(upper_[k]);
        const Float16 above = Float16(lower_[k]) - Float16(to + (3 + k) * simd::width);
        const Float16 gap = max(max(below, above), Float16(0.0F));
        sum = sum + gap * gap;
      }
      return sum;
    }

   private:
    std::array<float, 3> lower_, upper_;
  };
};

/// For points: their coordinates.
template <>
struct Batch<Point> {
  static constexpr std::size_t floats = 3 * simd::width;
  static constexpr bool measures = true;

  static void set(float* at, std::size_t lane, const Point& p, const Vec3& origin, double scale) noexcept {
    for (int k = 0; k < 3; ++k)
      at[static_cast<std::size_t>(k) * simd::width + lane] = static_cast<float>((p.position[k] - origin[k]) * scale);
  }

  [[gnu::always_inline]] static FloatBox place(float* at, const Point* local, const std::uint32_t* group,
                                               std::span<const Frame> frames, const Vec3& origin,
                                               double scale) noexcept {
    using simd::Float4;
    const simd::Double4 o = simd::Double4::of(origin[0], origin[1], origin[2], 0.0), s(scale);
    Float4 lower(std::numeric_limits<float>::infinity()), upper(-std::numeric_limits<float>::infinity());
    for (std::size_t k = 0; k < simd::width; ++k) {
      const double* x = local[k].position.data();
      std::array<float, 4> placed;
      ((FrameColumns(frames[group[k]]).place(x[0], x[1], x[2]) - o) * s).store_rounded(placed.data());
      const Float4 rounded(placed.data());
      lower = min(lower, rounded);
      upper = max(upper, rounded);
      for (std::size_t axis = 0; axis < 3; ++axis) at[axis * simd::width + k] = placed[axis];
    }
    std::array<float, 4> low, high;
    lower.store(low.data());
    upper.store(high.data());
    return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
  }

  [[gnu::always_inline]] static FloatBox hull(const float* at) noexcept {
    FloatBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      const simd::Float16 x(at + k * simd::width);
      box.lower[k] = smallest(x);
      box.upper[k] = largest(x);
    }
    return box;
  }

  [[gnu::always_inline]] static simd::Bits inside(const float* at, const BoxLanes& box) noexcept {
    const auto axis = [&](std::size_t k) __attribute__((always_inline)) {
      const simd::Float16 x(at + k * simd::width);
      return less_equal(x, box.upper[k]) & less_equal(box.lower[k], x);
    };
    return axis(0) & axis(1) & axis(2);
  }

  class Grown {
   public:
    Grown(const float* at, float r) noexcept {
      for (std::size_t k = 0; k < 3; ++k) {
        const simd::Float16 x(at + k * simd::width);
        lower_[k] = x - simd::Float16(r);
        upper_[k] = x + simd::Float16(r);
      }
    }
    [[gnu::always_inline]] simd::Bits meets(const FloatBox& box) const noexcept {
      return lanes_meeting(lower_, upper_, box);
    }

   private:
    std::array<simd::Float16, 3> lower_, upper_;
  };

  /// Writes rotation (column by column) * local + translation for all sixteen. Returns the box around them.
  [[gnu::always_inline]] static FloatBox turn(const float* local, const std::array<float, 9>& rotation,
                                              const std::array<float, 3>& translation, float* to) noexcept {
    using simd::Float16;
    const Float16 x(local), y(local + simd::width), z(local + 2 * simd::width);
    FloatBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      const Float16 turned = x * Float16(rotation[k]) + y * Float16(rotation[3 + k]) + z * Float16(rotation[6 + k]) +
                             Float16(translation[k]);
      turned.store(to + k * simd::width);
      box.lower[k] = smallest(turned);
      box.upper[k] = largest(turned);
    }
    return box;
  }

  class One {
   public:
    explicit One(const float* at) noexcept : x_{at[0], at[simd::width], at[2 * simd::width]} {}
    One(const float* at, float scale, const std::array<float, 3>& shift) noexcept : One(at) {
      for (std::size_t k = 0; k < 3; ++k) x_[k] = x_[k] * scale + shift[k];
    }
    [[gnu::always_inline]] simd::Float16 squared_distances(const float* to) const noexcept {
      using simd::Float16;
      const Float16 x = Float16(to) - Float16(x_[0]), y = Float16(to + simd::width) - Float16(x_[1]),
                    z = Float16(to + 2 * simd::width) - Float16(x_[2]);
      return x * x + y * y + z * z;
    }

    /// Returns the primitive after the same rigid transform.
    One turned(const std::array<float, 9>& rotation, const std::array<float, 3>& translation) const noexcept {
      One to = *this;
      for (std::size_t k = 0; k < 3; ++k)
        to.x_[k] = x_[0] * rotation[k] + x_[1] * rotation[3 + k] + x_[2] * rotation[6 + k] + translation[k];
      return to;
    }
    float squared_distance(const One& to) const noexcept {
      const float x = to.x_[0] - x_[0], y = to.x_[1] - x_[1], z = to.x_[2] - x_[2];
      return x * x + y * y + z * z;
    }
    /// Returns the largest magnitude of a coordinate.
    float extent() const noexcept { return std::max({std::abs(x_[0]), std::abs(x_[1]), std::abs(x_[2])}); }

   private:
    std::array<float, 3> x_;
  };
};

/// Optional: a batch of one rigid group is transformed in float, without access to the primitives.
template <class P>
concept TransformsBatch = requires(const float* local, const std::array<float, 9>& rotation,
                                   const std::array<float, 3>& translation, float* to) {
  { Batch<P>::turn(local, rotation, translation, to) } -> std::same_as<FloatBox>;
};

/// Optional: squared_distances are the squared distances up to rounding, not only lower bounds.
template <class P>
concept MeasuresDistances = requires {
  requires Batch<P>::measures;
};

/// Optional: a single primitive of a batch can be transformed and measured without its batch. extent: the largest
/// magnitude of its coordinates.
template <class P>
concept TurnsOne = TransformsBatch<P> && MeasuresDistances<P> &&
    requires(const typename Batch<P>::One& one, const std::array<float, 9>& rotation,
             const std::array<float, 3>& translation) {
  { one.turned(rotation, translation) } -> std::same_as<typename Batch<P>::One>;
  { one.squared_distance(one) } -> std::same_as<float>;
  { one.extent() } -> std::same_as<float>;
};

static_assert(TurnsOne<Point>);

}  // namespace hinge::detail
