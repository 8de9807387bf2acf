// SPDX-License-Identifier: BSD-3-Clause
// Error-free transforms: a sum, difference or product of two doubles as a rounded value and its exact error.
#pragma once

#include <cfloat>
#include <cmath>
#include <type_traits>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "hinge/exact needs IEEE arithmetic: compile without -ffast-math (or -Ofast)"
#endif

namespace hinge::detail::exact {

static_assert(FLT_EVAL_METHOD == 0, "every operation has to round to double");

/// Half an ulp of 1 (u): the largest relative error of one rounding to nearest.
inline constexpr double half_ulp = 0x1p-53;

/// Upper bound of the underflow error of a sum of three squares. It is negligible for sums above this value.
inline constexpr double lost_squares = 0x1p-900;
/// A sum of squares up to this value had no overflow in its terms.
inline constexpr double largest_square = 0x1p1000;

/// The exact number value + rest, where value is that number rounded to nearest.
struct ValueAndError {
  double value = 0.0;
  double rest = 0.0;
};

/// Returns a + b (Knuth, The Art of Computer Programming 2, 4.2.2, theorem B). a and b are finite with a finite sum.
constexpr ValueAndError two_sum(double a, double b) noexcept {
  const double sum = a + b, of_b = sum - a, of_a = sum - of_b;
  return {sum, (a - of_a) + (b - of_b)};
}

/// Returns a + b for |a| >= |b| or a = 0 (Dekker 1971).
constexpr ValueAndError fast_two_sum(double a, double b) noexcept {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// Returns a - b; the conditions of two_sum apply.
constexpr ValueAndError two_difference(double a, double b) noexcept { return two_sum(a, -b); }

/// Returns a b (Veltkamp's splitting, Dekker's product). With a fused multiply-add the result is the same. Valid for
/// |a|, |b| <= 2^995 and a product that is 0 or has a magnitude in [2^-967, 2^1022]. Outside this range the halves
/// overflow or the error term underflows.
constexpr ValueAndError two_product(double a, double b) noexcept {
#ifdef __FP_FAST_FMA
  // This branch is also needed for correctness: with contraction enabled, g++ 12 fuses the product below into its own
  // subtraction.
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
