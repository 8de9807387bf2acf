// SPDX-License-Identifier: BSD-3-Clause
// Batch<P>: sixteen primitives side by side in float, and lower bounds of their distance to one more.
#pragma once

#include <array>
#include <cstddef>

#include "hinge/bounds/float_box.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/simd/lanes.hpp"

namespace hinge {

/// What engines hold of sixteen placed primitives; a view on `floats` numbers. The one for any primitive keeps their
/// boxes, so that a squared distance is bounded by the squared gap of boxes. A specialisation for a primitive that has
/// a better kernel offers the same members and, where the primitive keeps its shape under a rotation of its
/// coordinates, `turn`.
template <Primitive P>
struct Batch {
  static constexpr std::size_t floats = 6 * simd::width;

  /// Stores the primitive in a lane. (x - origin) * scale is what is kept of a coordinate x.
  static void set(float* at, std::size_t lane, const P& p, const Vec3& origin, double scale) noexcept {
    const Aabb box = p.bounds();
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k) * simd::width + lane;
      at[i] = static_cast<float>((box.lower[k] - origin[k]) * scale);
      at[i + 3 * simd::width] = static_cast<float>((box.upper[k] - origin[k]) * scale);
    }
  }

  /// The same for a primitive given in its group's frame.
  static void place(float* at, std::size_t lane, const P& local, const Frame& frame, const Vec3& origin,
                    double scale) noexcept {
    set(at, lane, local.placed(frame.pose()), origin, scale);
  }

  static FloatBox hull(const float* at) noexcept {
    FloatBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = smallest(simd::Float16(at + k * simd::width));
      box.upper[k] = largest(simd::Float16(at + (3 + k) * simd::width));
    }
    return box;
  }

  /// Lanes that share a point with the box.
  static simd::Bits inside(const float* at, const FloatBox& box) noexcept {
    simd::Bits bits = simd::all_bits;
    for (std::size_t k = 0; k < 3; ++k)
      bits &= less_equal(simd::Float16(at + k * simd::width), simd::Float16(box.upper[k])) &
              less_equal(simd::Float16(box.lower[k]), simd::Float16(at + (3 + k) * simd::width));
    return bits;
  }

  /// One primitive, moved by `shift` and scaled, against the sixteen of another batch: a lower bound of the squared
  /// distance, up to rounding.
  class One {
   public:
    One(const float* at, std::size_t lane) noexcept {
      for (std::size_t k = 0; k < 3; ++k) {
        lower_[k] = at[k * simd::width + lane];
        upper_[k] = at[(3 + k) * simd::width + lane];
      }
    }
    One(const float* at, std::size_t lane, float scale, const std::array<float, 3>& shift) noexcept : One(at, lane) {
      for (std::size_t k = 0; k < 3; ++k) {
        lower_[k] = lower_[k] * scale + shift[k];
        upper_[k] = upper_[k] * scale + shift[k];
      }
    }
    simd::Float16 squared_distances(const float* to) const noexcept {
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

/// Points: their coordinates.
template <>
struct Batch<Point> {
  static constexpr std::size_t floats = 3 * simd::width;

  static void set(float* at, std::size_t lane, const Point& p, const Vec3& origin, double scale) noexcept {
    for (int k = 0; k < 3; ++k)
      at[static_cast<std::size_t>(k) * simd::width + lane] = static_cast<float>((p.position[k] - origin[k]) * scale);
  }

  static void place(float* at, std::size_t lane, const Point& local, const Frame& frame, const Vec3& origin,
                    double scale) noexcept {
    std::array<double, 4> o{origin[0], origin[1], origin[2], 0.0}, x;
    const simd::Double4 placed = FrameColumns(frame).place(local.position[0], local.position[1], local.position[2]);
    ((placed - simd::Double4(o.data())) * simd::Double4(scale)).store(x.data());
    for (std::size_t k = 0; k < 3; ++k) at[k * simd::width + lane] = static_cast<float>(x[k]);
  }

  static FloatBox hull(const float* at) noexcept {
    FloatBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      const simd::Float16 x(at + k * simd::width);
      box.lower[k] = smallest(x);
      box.upper[k] = largest(x);
    }
    return box;
  }

  static simd::Bits inside(const float* at, const FloatBox& box) noexcept {
    simd::Bits bits = simd::all_bits;
    for (std::size_t k = 0; k < 3; ++k) {
      const simd::Float16 x(at + k * simd::width);
      bits &= less_equal(x, simd::Float16(box.upper[k])) & less_equal(simd::Float16(box.lower[k]), x);
    }
    return bits;
  }

  /// rotation (column by column) * local + translation, for all sixteen.
  static void turn(const float* local, const std::array<float, 9>& rotation, const std::array<float, 3>& translation,
                   float* to) noexcept {
    using simd::Float16;
    const Float16 x(local), y(local + simd::width), z(local + 2 * simd::width);
    for (std::size_t k = 0; k < 3; ++k)
      (x * Float16(rotation[k]) + y * Float16(rotation[3 + k]) + z * Float16(rotation[6 + k]) + Float16(translation[k]))
          .store(to + k * simd::width);
  }

  class One {
   public:
    One(const float* at, std::size_t lane) noexcept
        : x_{at[lane], at[simd::width + lane], at[2 * simd::width + lane]} {}
    One(const float* at, std::size_t lane, float scale, const std::array<float, 3>& shift) noexcept : One(at, lane) {
      for (std::size_t k = 0; k < 3; ++k) x_[k] = x_[k] * scale + shift[k];
    }
    simd::Float16 squared_distances(const float* to) const noexcept {
      using simd::Float16;
      const Float16 x = Float16(to) - Float16(x_[0]), y = Float16(to + simd::width) - Float16(x_[1]),
                    z = Float16(to + 2 * simd::width) - Float16(x_[2]);
      return x * x + y * y + z * z;
    }

   private:
    std::array<float, 3> x_;
  };
};

/// Optional: a rigid batch is placed by turning its floats, without looking at the primitives.
template <class P>
concept TurnsBatch = requires(const float* local, const std::array<float, 9>& rotation,
                              const std::array<float, 3>& translation, float* to) {
  Batch<P>::turn(local, rotation, translation, to);
};

static_assert(TurnsBatch<Point>);

}  // namespace hinge
