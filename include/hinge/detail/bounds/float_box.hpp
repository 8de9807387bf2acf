// SPDX-License-Identifier: BSD-3-Clause
// FloatBox and BoxRow: boxes in float, one and sixteen side by side, and the test of one against sixteen.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// A float that was just rounded, as a double. Where g++ 12 puts two conversions into one register (from -O2 on,
/// without any flag about floating point) it takes the double of float(x) for x; so it must not see where the float
/// came from.
[[gnu::always_inline]] inline double widened(float x) noexcept {
#if defined(__GNUC__) && !defined(__clang__)
#if defined(__x86_64__)
  asm("" : "+x"(x));
#else
  asm("" : "+m"(x));
#endif
#endif
  return static_cast<double>(x);
}

/// The smallest float not below x.
inline float float_above(double x) noexcept {
  const auto f = static_cast<float>(x);
  return widened(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

/// A closed axis-aligned box in float. The default is empty.
struct FloatBox {
  std::array<float, 3> lower{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::infinity()};
  std::array<float, 3> upper{-std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity()};

  FloatBox() = default;
  FloatBox(const std::array<float, 3>& low, const std::array<float, 3>& high) noexcept : lower(low), upper(high) {}

  /// All of space.
  static FloatBox everything() noexcept {
    constexpr float inf = std::numeric_limits<float>::infinity();
    return {{-inf, -inf, -inf}, {inf, inf, inf}};
  }
  /// Grown by r on every side, up to rounding. (Coordinate by coordinate, here and below: loops over arrays keep small
  /// boxes in memory, where what was just stored is slow to load again in other portions.)
  [[gnu::always_inline]] FloatBox grown(float r) const noexcept {
    return {{lower[0] - r, lower[1] - r, lower[2] - r}, {upper[0] + r, upper[1] + r, upper[2] + r}};
  }
  FloatBox& extend(const FloatBox& other) noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], other.lower[k]);
      upper[k] = std::max(upper[k], other.upper[k]);
    }
    return *this;
  }
  /// Largest magnitude of a coordinate of a box that is not empty.
  [[gnu::always_inline]] float extent() const noexcept {
    const float low = std::max(std::max(-lower[0], -lower[1]), -lower[2]);
    return std::max(low, std::max(std::max(upper[0], upper[1]), upper[2]));
  }
};

/// Sixteen boxes, coordinate by coordinate: all lower x, all lower y, ... Unused places hold the empty box.
struct alignas(64) BoxRow {
  static constexpr std::size_t size = simd::width;
  std::array<float, 3 * size> lower;
  std::array<float, 3 * size> upper;

  BoxRow() noexcept {
    lower.fill(std::numeric_limits<float>::infinity());
    upper.fill(-std::numeric_limits<float>::infinity());
  }
  void set(std::size_t lane, const FloatBox& box) noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k * size + lane] = box.lower[k];
      upper[k * size + lane] = box.upper[k];
    }
  }
  FloatBox get(std::size_t lane) const noexcept {
    FloatBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = lower[k * size + lane];
      box.upper[k] = upper[k * size + lane];
    }
    return box;
  }
  /// The box around all of them.
  FloatBox hull() const noexcept {
    FloatBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = smallest(simd::Float16(lower.data() + k * size));
      box.upper[k] = largest(simd::Float16(upper.data() + k * size));
    }
    return box;
  }
};

/// One box, ready to be held against many rows.
struct BoxLanes {
  explicit BoxLanes(const FloatBox& box) noexcept
      : lower{box.lower[0], box.lower[1], box.lower[2]}, upper{box.upper[0], box.upper[1], box.upper[2]} {}
  /// Grown by r on every side, up to rounding.
  [[gnu::always_inline]] BoxLanes grown(float r) const noexcept {
    BoxLanes box = *this;
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = lower[k] - simd::Float16(r);
      box.upper[k] = upper[k] + simd::Float16(r);
    }
    return box;
  }
  std::array<simd::Float16, 3> lower, upper;
};

/// Which of the sixteen share a point with the box. NaN counts as apart: coordinates are checked to be finite before.
[[gnu::always_inline]] inline simd::Bits overlapping(const BoxRow& row, const BoxLanes& box) noexcept {
  using simd::Float16;
  constexpr std::size_t n = BoxRow::size;
  const auto axis = [&](std::size_t k) __attribute__((always_inline)) {
    return less_equal(Float16(row.lower.data() + k * n), box.upper[k]) &
           less_equal(box.lower[k], Float16(row.upper.data() + k * n));
  };
  return axis(0) & axis(1) & axis(2);
}

}  // namespace hinge::detail
