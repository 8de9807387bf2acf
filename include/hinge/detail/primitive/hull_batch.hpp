// SPDX-License-Identifier: BSD-3-Clause
// Batch for primitives whose hull has one point (points, balls) or two points (capsules).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/kinematics/compose_frames.hpp"
#include "hinge/detail/primitive/box_batch.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// True for a hull of one or two points: a point or a segment.
template <class P>
concept HasSmallHull = HasHull<P> &&(hull_size<P> <= 2);

/// The hull points by coordinate, then the hull radii if P has any. A rigid transform moves the points and keeps the
/// radii.
template <Primitive P>
requires HasSmallHull<P>
struct Batch<P> {
  static constexpr std::size_t points = hull_size<P>;
  static constexpr bool has_radius = !HasSharpHull<P>;
  static constexpr std::size_t coordinates = 3 * points * simd::width;
  static constexpr std::size_t floats = coordinates + (has_radius ? simd::width : 0);
  static constexpr bool measures = points == 1 && !has_radius;
  static constexpr bool squared_limits = !has_radius;
  static constexpr double slack = measures ? 0.0 : 32.0;

  static void set(float* at, std::size_t lane, const P& p, const Vec3& origin, double scale) noexcept {
    const auto hull = p.hull();
    for (std::size_t row = 0; row < 3 * points; ++row) {
      const auto axis = static_cast<Eigen::Index>(row % 3);
      at[row * simd::width + lane] = static_cast<float>((hull[row / 3][axis] - origin[axis]) * scale);
    }
    if constexpr (has_radius) at[coordinates + lane] = float_above(p.hull_radius() * scale);
  }

  /// The radii must be in place: see set().
  [[gnu::always_inline]] static FloatBox place(float* at, const P* local, const std::uint32_t* group,
                                               std::span<const Frame> frames, const Vec3& origin,
                                               double scale) noexcept {
    using simd::Float4;
    const simd::Double4 o = simd::Double4::of(origin[0], origin[1], origin[2], 0.0), s(scale);
    Float4 lower(std::numeric_limits<float>::infinity()), upper(-std::numeric_limits<float>::infinity());
    for (std::size_t k = 0; k < simd::width; ++k) {
      const auto hull = local[k].hull();
      for (std::size_t p = 0; p < points; ++p) {
        const double* x = hull[p].data();
        std::array<float, 4> placed;
        ((FrameColumns(frames[group[k]]).place(x[0], x[1], x[2]) - o) * s).store_rounded(placed.data());
        const Float4 rounded(placed.data());
        if constexpr (has_radius) {
          const Float4 radius(at[coordinates + k]);
          lower = min(lower, rounded - radius);
          upper = max(upper, rounded + radius);
        } else {
          lower = min(lower, rounded);
          upper = max(upper, rounded);
        }
        for (std::size_t axis = 0; axis < 3; ++axis) at[(3 * p + axis) * simd::width + k] = placed[axis];
      }
    }
    std::array<float, 4> low, high;
    lower.store(low.data());
    upper.store(high.data());
    return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
  }

  [[gnu::always_inline]] static FloatBox hull(const float* at) noexcept {
    FloatBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = smallest(lower(at, k));
      box.upper[k] = largest(upper(at, k));
    }
    return box;
  }

  [[gnu::always_inline]] static simd::Bits inside(const float* at, const BoxLanes& box) noexcept {
    const auto axis = [&](std::size_t k) __attribute__((always_inline)) {
      return less_equal(lower(at, k), box.upper[k]) & less_equal(box.lower[k], upper(at, k));
    };
    return axis(0) & axis(1) & axis(2);
  }

  class Grown {
   public:
    Grown(const float* at, float r) noexcept {
      for (std::size_t k = 0; k < 3; ++k) {
        lower_[k] = lower(at, k) - simd::Float16(r);
        upper_[k] = upper(at, k) + simd::Float16(r);
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
    for (std::size_t p = 0; p < points; ++p) {
      const float* const from = local + 3 * p * simd::width;
      const Float16 x(from), y(from + simd::width), z(from + 2 * simd::width);
      for (std::size_t k = 0; k < 3; ++k)
        (x * Float16(rotation[k]) + y * Float16(rotation[3 + k]) + z * Float16(rotation[6 + k]) +
         Float16(translation[k]))
            .store(to + (3 * p + k) * simd::width);
    }
    if constexpr (has_radius) Float16(local + coordinates).store(to + coordinates);
    return hull(to);
  }

  class One {
   public:
    explicit One(const float* at) noexcept {
      for (std::size_t row = 0; row < x_.size(); ++row) x_[row] = at[row * simd::width];
      if constexpr (has_radius) radius_ = at[coordinates];
    }
    One(const float* at, float scale, const std::array<float, 3>& shift) noexcept : One(at) {
      for (std::size_t row = 0; row < x_.size(); ++row) x_[row] = x_[row] * scale + shift[row % 3];
      radius_ *= scale;
    }

    [[gnu::always_inline]] simd::Bits near(const float* to, const simd::Float16& limit) const noexcept {
      // Negated on purpose: overflow and NaN must remain.
      if constexpr (has_radius) {
        const simd::Float16 within = limit + (simd::Float16(radius_) + simd::Float16(to + coordinates));
        return ~less(within * within, squared_distances(to));
      } else {
        return ~less(limit, squared_distances(to));
      }
    }

    /// Squared distances of the hulls, without the radii. One point: up to rounding. Two points: a lower bound.
    [[gnu::always_inline]] simd::Float16 squared_distances(const float* to) const noexcept {
      if constexpr (points == 1) {
        const Lanes3 d = point(to, 0) - point(0);
        return dot(d, d);
      } else {
        return squared_gap(point(0), point(1), point(to, 0), point(to, 1));
      }
    }

    /// Returns the primitive after the same rigid transform.
    One turned(const std::array<float, 9>& rotation, const std::array<float, 3>& translation) const noexcept {
      One to = *this;
      for (std::size_t row = 0; row < x_.size(); ++row) {
        const std::size_t k = row % 3;
        const float* const x = x_.data() + (row - k);
        to.x_[row] = x[0] * rotation[k] + x[1] * rotation[3 + k] + x[2] * rotation[6 + k] + translation[k];
      }
      return to;
    }
    /// Returns true if the distance of two points or balls is below `limit` up to rounding.
    bool closer_than(const One& to, float limit) const noexcept requires(points == 1 && FillsHull<P>) {
      const float x = to.x_[0] - x_[0], y = to.x_[1] - x_[1], z = to.x_[2] - x_[2];
      const float within = limit + (radius_ + to.radius_);
      return within > 0.0F && x * x + y * y + z * z < within * within;
    }
    /// Returns the largest magnitude of a coordinate, the radius included.
    float extent() const noexcept {
      float most = 0.0F;
      for (const float x : x_) most = std::max(most, std::abs(x) + radius_);
      return most;
    }

   private:
    struct Lanes3 {
      simd::Float16 x, y, z;
      [[gnu::always_inline]] friend Lanes3 operator-(const Lanes3& a, const Lanes3& b) noexcept {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
      }
      [[gnu::always_inline]] friend Lanes3 operator+(const Lanes3& a, const Lanes3& b) noexcept {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
      }
      [[gnu::always_inline]] friend Lanes3 operator*(const Lanes3& a, const simd::Float16& s) noexcept {
        return {a.x * s, a.y * s, a.z * s};
      }
    };
    [[gnu::always_inline]] static simd::Float16 dot(const Lanes3& a, const Lanes3& b) noexcept {
      return a.x * b.x + a.y * b.y + a.z * b.z;
    }
    [[gnu::always_inline]] Lanes3 point(std::size_t p) const noexcept {
      return {simd::Float16(x_[3 * p]), simd::Float16(x_[3 * p + 1]), simd::Float16(x_[3 * p + 2])};
    }
    [[gnu::always_inline]] static Lanes3 point(const float* at, std::size_t p) noexcept {
      const float* const row = at + 3 * p * simd::width;
      return {simd::Float16(row), simd::Float16(row + simd::width), simd::Float16(row + 2 * simd::width)};
    }

    /// Squared gap of the segments a a2 and b b2 along the line through their nearest points. Any line gives a lower
    /// bound of the distance, so rounding in the search for the nearest points cannot invalidate it.
    [[gnu::always_inline]] static simd::Float16 squared_gap(const Lanes3& a, const Lanes3& a2, const Lanes3& b,
                                                            const Lanes3& b2) noexcept {
      using simd::Float16;
      const Float16 zero(0.0F), one(1.0F), tiny(1e-30F);  // tiny: no division by 0
      const auto clamped = [&](const Float16& x) __attribute__((always_inline)) { return max(min(x, one), zero); };
      const Lanes3 u = a2 - a, v = b2 - b, r = a - b;
      const Float16 uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
      const Float16 first = clamped((uv * vr - ur * vv) / (max(uu * vv - uv * uv, zero) + tiny));
      const Float16 t = clamped((uv * first + vr) / (vv + tiny)), s = clamped((uv * t - ur) / (uu + tiny));
      const Lanes3 line = (b + v * t) - (a + u * s);
      const Float16 gap = max(min(dot(line, b), dot(line, b2)) - max(dot(line, a), dot(line, a2)), zero);
      return gap *
             (gap / dot(line, line));  // the square of the gap could overflow; NaN for nearest points that coincide
    }

    std::array<float, 3 * points> x_;
    float radius_ = 0.0F;
  };

 private:
  /// Lower and upper ends of the sixteen primitives along an axis.
  [[gnu::always_inline]] static simd::Float16 lower(const float* at, std::size_t axis) noexcept {
    simd::Float16 x(at + axis * simd::width);
    if constexpr (points == 2) x = min(x, simd::Float16(at + (3 + axis) * simd::width));
    if constexpr (has_radius) x = x - simd::Float16(at + coordinates);
    return x;
  }
  [[gnu::always_inline]] static simd::Float16 upper(const float* at, std::size_t axis) noexcept {
    simd::Float16 x(at + axis * simd::width);
    if constexpr (points == 2) x = max(x, simd::Float16(at + (3 + axis) * simd::width));
    if constexpr (has_radius) x = x + simd::Float16(at + coordinates);
    return x;
  }
};

}  // namespace hinge::detail
