// SPDX-License-Identifier: BSD-3-Clause
// Sine and cosine with the same bits on every CPU and compiler, which libm does not promise.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace hinge::detail {

/// Sine and cosine of one angle.
struct SinCos {
  double sin = 0.0;
  double cos = 1.0;
};

/// Returns sin and cos of a finite angle (rad), within 1.5 ulp for every finite argument. sincos(0) is exactly {0, 1}.
/// It uses only + - * and integers, so the result depends on the argument alone (with -ffp-contract=off).
SinCos sincos(double angle) noexcept;

/// An angle reduced to quadrant * pi/2 + (high + low), with |high| <= pi/4 up to rounding.
struct Reduced {
  unsigned quadrant = 0;
  double high = 0.0;
  double low = 0.0;
};

/// Limit of the Cody & Waite reduction (rad). Below it the quadrant number has at most 20 bits, so its products with
/// the 33-bit parts of pi/2 are exact.
inline constexpr double cody_waite_limit = 0x1p20;

inline constexpr double rounder = 0x1.8p52;  // adding and subtracting it rounds a double to an integer

/// Reduces x to n * pi/2 + (high + low), where n is the nearest integer. T: double, or SIMD lanes of double. A struct
/// of lanes as the result would go through memory, in stores too narrow for the loads that follow.
template <class T>
[[gnu::always_inline]] inline void reduce_parts(const T& x, T& n, T& high, T& low) noexcept {
  constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
  constexpr double part1 = 0x1.921fb544p+0, part2 = 0x1.0b4611a6p-34, part3 = 0x1.3198a2e037073p-69;
  n = (x * T(two_over_pi) + T(rounder)) - T(rounder);
  const T a = x - n * T(part1);
  const T b = n * T(part2);
  const T r = a - b;
  const T tail = ((a - r) - b) - n * T(part3);
  high = r + tail;
  low = (r - high) + tail;
}

inline Reduced reduce_small(double x) noexcept {
  double n = 0.0, high = 0.0, low = 0.0;
  reduce_parts(x, n, high, low);
  return {static_cast<unsigned>(static_cast<std::int64_t>(n)) & 3U, high, low};
}

/// Reduction of Payne & Hanek for large angles: multiplies the 53-bit mantissa by the relevant bits of 2/pi, modulo 4.
inline Reduced reduce_large(double x) noexcept {
  __extension__ using Wide = unsigned __int128;
  // 2/pi = 0.word0 word1 ...: enough words for the largest exponent plus 192 bits.
  constexpr std::array<std::uint64_t, 20> two_over_pi = {
      0xa2f9836e4e441529ULL, 0xfc2757d1f534ddc0ULL, 0xdb6295993c439041ULL, 0xfe5163abdebbc561ULL,
      0xb7246e3a424dd2e0ULL, 0x06492eea09d1921cULL, 0xfe1deb1cb129a73eULL, 0xe88235f52ebb4484ULL,
      0xe99c7026b45f7e41ULL, 0x3991d639835339f4ULL, 0x9c845f8bbdf9283bULL, 0x1ff897ffde05980fULL,
      0xef2f118b5a0a6d1fULL, 0x6d367ecf27cb09b7ULL, 0x4f463f669e5fea2dULL, 0x7527bac7ebe5f17bULL,
      0x3d0739f78a5292eaULL, 0x6bfb5fb11f8d5d08ULL, 0x56033046fc7b6babULL, 0xf0cfbc209af4361dULL};
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int exponent = static_cast<int>((bits >> 52) & 0x7ffU) - 1075;  // x = +- mantissa * 2^exponent
  const std::uint64_t mantissa = (bits & 0xf'ffff'ffff'ffffULL) | 0x10'0000'0000'0000ULL;
  const auto word = [&](int offset) noexcept {  // 64 bits of 2/pi from this bit; 0 before the binary point
    std::uint64_t value = 0;
    for (int k = 0; k < 2; ++k) {
      const int position = (offset >= 0 ? offset / 64 : -((63 - offset) / 64)) + k;
      const int shift = offset - 64 * (position - k);
      if (position < 0 || position >= 20) continue;
      const std::uint64_t w = two_over_pi[static_cast<std::size_t>(position)];
      if (k == 0) value |= w << shift;
      if (k == 1 && shift > 0) value |= w >> (64 - shift);
    }
    return value;
  };
  // Bits of weight 4 or more vanish modulo 4, so the window starts at weight 2.
  const int start = exponent - 2;
  const Wide p2 = Wide{word(start + 128)} * mantissa;
  const Wide p1 = Wide{word(start + 64)} * mantissa + static_cast<std::uint64_t>(p2 >> 64);
  const std::uint64_t top = word(start) * mantissa + static_cast<std::uint64_t>(p1 >> 64);
  auto quadrant = static_cast<unsigned>(top >> 62);
  Wide fraction = (Wide{top} << 66) | (Wide{static_cast<std::uint64_t>(p1)} << 2) |
                  (static_cast<std::uint64_t>(p2) >> 62);  // fraction of a quadrant, 128 bits
  const bool upper_half = (fraction >> 127) != 0;
  if (upper_half) {
    ++quadrant;
    fraction = -fraction;
  }
  // Split the fraction into two doubles and multiply by pi/2, also split.
  const double first = static_cast<double>(static_cast<std::uint64_t>(fraction >> 75)) * 0x1p-53;  // leading 53 bits
  const Wide rest = fraction & ((Wide{1} << 75) - 1);
  const double second = static_cast<double>(static_cast<std::uint64_t>(rest >> 11)) * 0x1p-117;
  constexpr double pio2_a = 0x1.921fb5p+0, pio2_b = 0x1.110b46p-26, pio2_c = 0x1.1a62633145c07p-54;
  const double leading = std::bit_cast<double>(std::bit_cast<std::uint64_t>(first) & ~0x3ff'ffffULL);  // 27 bits
  const double trailing = first - leading;
  const double exact = leading * pio2_a;
  const double small =
      (leading * pio2_b + trailing * pio2_a) + (trailing * pio2_b + (first * pio2_c + second * 0x1.921fb54442d18p+0));
  const double high = exact + small;
  const double low = (exact - high) + small;
  const bool negate = upper_half;
  Reduced reduced{quadrant & 3U, negate ? -high : high, negate ? -low : low};
  if (x < 0.0) reduced = {(4U - reduced.quadrant) & 3U, -reduced.high, -reduced.low};
  return reduced;
}

/// Computes the sine and cosine of x + low, |x| <= pi/4 up to rounding. T: double, or SIMD lanes of double.
template <class T>
[[gnu::always_inline]] inline void sincos_of_reduced(const T& x, const T& low, T& s, T& c) noexcept {
  const T z = x * x, one = T(1.0);
  // Taylor polynomials, highest power first. For |x| <= pi/4 the first omitted terms are below 3e-18.
  const auto horner = [&z](const auto& coefficients) {
    T sum = T(coefficients[0]);
    for (std::size_t k = 1; k < coefficients.size(); ++k) sum = T(coefficients[k]) + z * sum;
    return sum;
  };
  constexpr std::array<double, 8> sine = {1.0 / 355687428096000.0,
                                          -1.0 / 1307674368000.0,
                                          1.0 / 6227020800.0,
                                          -1.0 / 39916800,
                                          1.0 / 362880,
                                          -1.0 / 5040,
                                          1.0 / 120,
                                          -1.0 / 6};
  constexpr std::array<double, 7> cosine = {1.0 / 20922789888000.0,
                                            -1.0 / 87178291200.0,
                                            1.0 / 479001600.0,
                                            -1.0 / 3628800,
                                            1.0 / 40320,
                                            -1.0 / 720,
                                            1.0 / 24};
  const T half = z * T(0.5);
  s = x + (x * z * horner(sine) + low * (one - half));
  const T w = one - half;
  c = w + (((one - w) - half) + (z * z * horner(cosine) - x * low));
}

inline SinCos sincos(double angle) noexcept {
  const Reduced r = std::abs(angle) <= cody_waite_limit ? reduce_small(angle) : reduce_large(angle);
  double s, c;
  sincos_of_reduced(r.high, r.low, s, c);
  switch (r.quadrant) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
  }
}

}  // namespace hinge::detail
