// SPDX-License-Identifier: BSD-3-Clause
// PlainPoint: Point with decisions by one comparison in double and the same kernels, the baseline of exact decisions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/primitive/batch.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge::bench {

/// A point with plain double decisions.
struct PlainPoint {
  Point point;
  static constexpr bool is_point_like = IsPointLike<Point>;  ///< engines may skip the same pairs

  PlainPoint placed(const Pose& pose) const noexcept { return {point.placed(pose)}; }
  Aabb bounds() const noexcept { return point.bounds(); }
  bool fixed_on_axis(const Vec3& axis_point, const Vec3& axis) const noexcept {
    return point.fixed_on_axis(axis_point, axis);
  }

  friend double squared_distance(const PlainPoint& p, const PlainPoint& q) noexcept {
    return squared_norm(Vec3(p.point.position - q.point.position));
  }
  friend bool closer_than(const PlainPoint& p, const PlainPoint& q, double m) noexcept {
    return squared_distance(p, q) < m * m;
  }
  friend std::pair<Vec3, Vec3> closest_points(const PlainPoint& p, const PlainPoint& q) noexcept {
    return {p.point.position, q.point.position};
  }
};

}  // namespace hinge::bench

namespace hinge {

/// The batch of Point, the only member of PlainPoint.
template <>
struct detail::Batch<bench::PlainPoint> {
  using Same = Batch<Point>;
  using Grown = Same::Grown;
  using One = Same::One;
  static constexpr std::size_t floats = Same::floats;
  static_assert(sizeof(bench::PlainPoint) == sizeof(Point));

  static void set(float* at, std::size_t lane, const bench::PlainPoint& p, const Vec3& origin, double scale) noexcept {
    Same::set(at, lane, p.point, origin, scale);
  }
  [[gnu::always_inline]] static FloatBox place(float* at, const bench::PlainPoint* local, const std::uint32_t* group,
                                               std::span<const Frame> frames, const Vec3& origin,
                                               double scale) noexcept {
    return Same::place(at, reinterpret_cast<const Point*>(local), group, frames, origin, scale);
  }
  [[gnu::always_inline]] static FloatBox hull(const float* at) noexcept { return Same::hull(at); }
  [[gnu::always_inline]] static simd::Bits inside(const float* at, const BoxLanes& box) noexcept {
    return Same::inside(at, box);
  }
  [[gnu::always_inline]] static FloatBox turn(const float* local, const std::array<float, 9>& rotation,
                                              const std::array<float, 3>& translation, float* to) noexcept {
    return Same::turn(local, rotation, translation, to);
  }
};

static_assert(HasClosestPoints<bench::PlainPoint> && detail::TransformsBatch<bench::PlainPoint>);

}  // namespace hinge
