// SPDX-License-Identifier: BSD-3-Clause
// Error-free transforms: a sum, difference or product of two doubles as its rounded value and the exact rest.
#pragma once

#include <cfloat>
#include <cmath>
#include <type_traits>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "hinge/exact needs IEEE arithmetic: compile without -ffast-math (or -Ofast)"
#endif

namespace hinge::detail::exact {

static_assert(FLT_EVAL_METHOD == 0, "every operation has to round to double");

/// Half an ulp of 1: the largest relative error of one rounding to nearest.
inline constexpr double half_ulp = 0x1p-53;

/// What a sum of three squares may lose to underflow, at most; nothing to sums above it.
inline constexpr double lost_squares = 0x1p-900;
/// No sum of squares up to here has overflowed on the way.
inline constexpr double largest_square = 0x1p1000;

/// value + rest, exactly; value is that sum rounded to nearest.
struct ValueAndError {
  double value = 0.0;
  double rest = 0.0;
};

/// a + b (Knuth, The Art of Computer Programming 2, 4.2.2, theorem B); any finite a and b whose sum is finite.
constexpr ValueAndError two_sum(double a, double b) noexcept {
  const double sum = a + b, of_b = sum - a, of_a = sum - of_b;
  return {sum, (a - of_a) + (b - of_b)};
}

/// a + b when |a| >= |b| or a = 0 (Dekker 1971).
constexpr ValueAndError fast_two_sum(double a, double b) noexcept {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

constexpr ValueAndError two_difference(double a, double b) noexcept { return two_sum(a, -b); }

/// a b (Veltkamp's splitting, Dekker's product; the same numbers from a fused multiply-add where the CPU has one).
/// Holds for |a|, |b| <= 2^995 and a product that is 0 or has a magnitude in [2^-967, 2^1022]; beyond, the halves
/// overflow or the rest underflows.
constexpr ValueAndError two_product(double a, double b) noexcept {
#ifdef __FP_FAST_FMA
  // Also because compilers that are left to contract fuse the product below into its own subtraction (g++ 12).
  if (!std::is_constant_evaluated()) {
    const double rounded = a * b;
    return {rounded, std::fma(a, b, -rounded)};
  }
#endif
  constexpr double splitter = 0x1p27 + 1.0;
  const double ca = splitter * a, cb = splitter * b;
  const double high_a = ca - (ca - a), low_a = a - high_a, high_b = cb - (cb - b), low_b = b - high_b;
  const double product = a * b;
  return {product, low_a * low_b - (((product - high_a * high_b) - low_a * high_b) - high_a * low_b)};
}

}  // namespace hinge::detail::exact
