// SPDX-License-Identifier: BSD-3-Clause
// Tests for finite numbers and for valid lengths. They read the bit pattern, since -ffast-math folds std::isfinite to
// true.
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "hinge/core/vec3.hpp"

namespace hinge {

/// Returns true when x is neither infinite nor NaN.
inline bool is_finite(double x) noexcept {
  constexpr std::uint64_t exponent = 0x7ff0'0000'0000'0000ULL;
  return (std::bit_cast<std::uint64_t>(x) & exponent) != exponent;
}

/// Returns true when all numbers are finite.
inline bool is_finite(std::span<const double> numbers) noexcept {
  constexpr std::uint64_t exponent = 0x7ff0'0000'0000'0000ULL;
  std::uint64_t sums = 0;  // an exponent of ones, plus one, is the highest bit; so compilers vectorise the loop
  for (const double x : numbers) sums |= (std::bit_cast<std::uint64_t>(x) & exponent) + (1ULL << 52);
  return sums >> 63 == 0;
}

/// Returns true when all three components are finite.
inline bool is_finite(const Vec3& x) noexcept { return is_finite(x[0]) && is_finite(x[1]) && is_finite(x[2]); }

/// Largest accepted magnitude of a length, a coordinate or a prismatic joint value (2^1000 model units, about 1e301). A
/// chain of four million links of this length, and the boxes around it, stay below the largest double (2^1024), so no
/// computation yields infinity.
inline constexpr double largest_length = 0x1p1000;

/// Returns true when x is finite and |x| <= largest_length. Negative values are allowed.
inline bool is_length(double x) noexcept {
  constexpr std::uint64_t magnitude = 0x7fff'ffff'ffff'ffffULL;
  return (std::bit_cast<std::uint64_t>(x) & magnitude) <= std::bit_cast<std::uint64_t>(largest_length);
}

/// Returns true when all three components satisfy is_length.
inline bool is_length(const Vec3& x) noexcept { return is_length(x[0]) && is_length(x[1]) && is_length(x[2]); }

}  // namespace hinge
