// SPDX-License-Identifier: BSD-3-Clause
// FloatBox and BoxRow: a single float box and sixteen float boxes in SIMD layout, and the overlap test between them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// Converts a freshly rounded float to double. When g++ 12 combines two conversions in one register (from -O2 on,
/// without any floating-point flag), it uses x for the double of float(x). The asm statement hides the origin of the
/// float.
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

/// Returns the smallest float that is not below x.
inline float float_above(double x) noexcept {
  const auto f = static_cast<float>(x);
  return widened(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

/// A closed axis-aligned box in float. The default box is empty.
struct FloatBox {
  std::array<float, 3> lower{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::infinity()};
  std::array<float, 3> upper{-std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity()};

  FloatBox() = default;
  FloatBox(const std::array<float, 3>& low, const std::array<float, 3>& high) noexcept : lower(low), upper(high) {}

  /// Returns the box that contains all of space.
  static FloatBox everything() noexcept {
    constexpr float inf = std::numeric_limits<float>::infinity();
    return {{-inf, -inf, -inf}, {inf, inf, inf}};
  }
  /// Returns the box enlarged by r on every side, up to rounding. The coordinates are written one by one, here and
  /// below: a loop would keep small boxes in memory, and loads of another width soon after a store are slow.
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
  /// Returns the largest magnitude of a coordinate. The box must not be empty.
  [[gnu::always_inline]] float extent() const noexcept {
    const float low = std::max(std::max(-lower[0], -lower[1]), -lower[2]);
    return std::max(low, std::max(std::max(upper[0], upper[1]), upper[2]));
  }
};

/// Sixteen boxes in SIMD layout: all lower x, all lower y, and so on. Unused lanes hold the empty box.
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
  /// Returns the box around all sixteen boxes.
  FloatBox hull() const noexcept {
    FloatBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = smallest(simd::Float16(lower.data() + k * size));
      box.upper[k] = largest(simd::Float16(upper.data() + k * size));
    }
    return box;
  }
};

/// One box, broadcast to all lanes for tests against many rows.
struct BoxLanes {
  [[gnu::always_inline]] explicit BoxLanes(const FloatBox& box) noexcept
      : lower{box.lower[0], box.lower[1], box.lower[2]}, upper{box.upper[0], box.upper[1], box.upper[2]} {}
  /// Returns the box enlarged by r on every side, up to rounding.
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

/// Returns the lanes whose box shares a point with `box`. A NaN counts as disjoint; coordinates were checked earlier.
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
