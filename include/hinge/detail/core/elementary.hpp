// SPDX-License-Identifier: BSD-3-Clause
// Elementary functions with the same bits on every CPU and compiler, which libm does not promise: atan2 and log.
#pragma once

#include <bit>
#include <cmath>
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

/// Returns the natural logarithm of a positive x that is neither infinite nor subnormal. With x = 2^e m and m in
/// [0.7, 1.42), log m = 2 artanh((m - 1) / (m + 1)). The first omitted term of the series is below 1e-19.
inline double log(double x) noexcept {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  auto exponent = static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0xf'ffff'ffff'ffffULL) | 0x3ff0'0000'0000'0000ULL);
  if (m > 1.4142135623730951) {
    m /= 2;
    ++exponent;
  }
  const double s = (m - 1.0) / (m + 1.0), z = s * s;
  double series = 0.0;
  for (int n = 23; n >= 1; n -= 2) series = series * z + 1.0 / n;
  return exponent * 0.6931471805599453 + 2.0 * s * series;
}

}  // namespace hinge::detail
