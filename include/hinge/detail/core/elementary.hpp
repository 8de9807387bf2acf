// SPDX-License-Identifier: BSD-3-Clause
// Elementary functions with the same bits on every CPU and compiler, which libm does not promise: atan2 and log.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include "hinge/detail/core/sincos.hpp"

namespace hinge::detail {

/// Returns the angle of the vector (x, y) from the x axis (rad), in [-pi, pi], within 3 ulp. Zeros, infinities and NaN
/// are handled as in std::atan2. It uses only + - * / and sincos (with -ffp-contract=off).
inline double atan2(double y, double x) noexcept {
  if (std::isnan(x) || std::isnan(y)) return std::numeric_limits<double>::quiet_NaN();
  const double across = std::abs(x), up = std::abs(y);
  const bool steep = up > across;
  const double longer = steep ? up : across, shorter = steep ? across : up;
  double slope = 0.0;  // in [0, 1]
  if (longer == shorter)
    slope = longer > 0.0 ? 1.0 : 0.0;
  else if (!std::isinf(longer))
    slope = shorter / longer;
  double angle = slope;
  if (slope > 0x1p-28) {  // otherwise the first omitted term of the series, slope^3 / 3, is below half an ulp
    // A first guess within 0.005 rad, then two steps. Each turns the vector back by the angle and adds what remains.
    // After the first step at most s^5 / 5 < 1e-12 remains.
    angle = slope / (1.0 + 0.28 * slope * slope);
    for (int step = 0; step < 2; ++step) {
      const SinCos turn = sincos(angle);
      const double s = (slope * turn.cos - turn.sin) / (turn.cos + slope * turn.sin);
      angle += s - s * s * s / 3.0;
    }
  }
  constexpr double rest_of_pi = 0x1.1a62633145c07p-53;  // pi minus the double that is nearest to it
  if (steep) angle = std::numbers::pi / 2.0 - (angle - rest_of_pi / 2.0);
  if (std::signbit(x)) angle = std::numbers::pi - (angle - rest_of_pi);
  return std::copysign(angle, y);
}

/// Returns log(2^exponent m), m in [0.7, 1.42]: log m = 2 artanh((m - 1) / (m + 1)). The first omitted term of the
/// series is below 1e-19. T: double, or SIMD lanes of double.
template <class T>
[[gnu::always_inline]] inline T log_of_parts(const T& m, const T& exponent) noexcept {
  constexpr std::array<double, 12> coefficients = {1.0 / 23, 1.0 / 21, 1.0 / 19, 1.0 / 17, 1.0 / 15, 1.0 / 13,
                                                   1.0 / 11, 1.0 / 9,  1.0 / 7,  1.0 / 5,  1.0 / 3,  1.0};
  const T s = (m - T(1.0)) / (m + T(1.0)), z = s * s;
  T series(coefficients[0]);
  for (std::size_t k = 1; k < coefficients.size(); ++k) series = series * z + T(coefficients[k]);
  return exponent * T(0.6931471805599453) + T(2.0) * s * series;
}

inline constexpr std::uint64_t mantissa_bits = 0xf'ffff'ffff'ffff;       ///< of a double
inline constexpr std::uint64_t exponent_of_one = 0x3ff0'0000'0000'0000;  ///< the bits of 1.0
inline constexpr double root_of_two = 1.4142135623730951;

/// Returns the natural logarithm of a positive x that is neither infinite nor subnormal.
inline double log(double x) noexcept {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const double m = std::bit_cast<double>((bits & mantissa_bits) | exponent_of_one);
  const auto exponent = static_cast<double>(static_cast<int>(bits >> 52) - 1023);
  return root_of_two < m ? log_of_parts(m * 0.5, exponent + 1.0) : log_of_parts(m, exponent);
}

}  // namespace hinge::detail
