// SPDX-License-Identifier: BSD-3-Clause
// FloatBox and BoxRow: boxes in float, one and sixteen side by side, and the test of one against sixteen.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "hinge/simd/lanes.hpp"

namespace hinge {

/// The smallest float not below x.
inline float float_above(double x) noexcept {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
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
  /// Grown by r on every side, up to rounding.
  FloatBox grown(float r) const noexcept {
    FloatBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = lower[k] - r;
      box.upper[k] = upper[k] + r;
    }
    return box;
  }
  FloatBox& extend(const FloatBox& other) noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], other.lower[k]);
      upper[k] = std::max(upper[k], other.upper[k]);
    }
    return *this;
  }
  /// Largest magnitude of a coordinate of a box that is not empty.
  float extent() const noexcept {
    float e = 0.0F;
    for (std::size_t k = 0; k < 3; ++k) e = std::max(e, std::max(-lower[k], upper[k]));
    return e;
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

/// Which of the sixteen share a point with the box. NaN counts as apart: coordinates are checked to be finite before.
[[gnu::always_inline]] inline simd::Bits overlapping(const BoxRow& row, const FloatBox& box) noexcept {
  using simd::Float16;
  constexpr std::size_t n = BoxRow::size;
  simd::Bits bits = simd::all_bits;
  for (std::size_t k = 0; k < 3; ++k)
    bits &= less_equal(Float16(row.lower.data() + k * n), Float16(box.upper[k])) &
            less_equal(Float16(box.lower[k]), Float16(row.upper.data() + k * n));
  return bits;
}

}  // namespace hinge
