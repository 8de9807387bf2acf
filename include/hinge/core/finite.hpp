// SPDX-License-Identifier: BSD-3-Clause
// What counts as a number and as a length, by bit pattern: std::isfinite is folded to true under -ffast-math.
#pragma once

#include <bit>
#include <cstdint>

#include "hinge/core/vec3.hpp"

namespace hinge {

inline bool is_finite(double x) noexcept {
  constexpr std::uint64_t exponent = 0x7ff0'0000'0000'0000ULL;
  return (std::bit_cast<std::uint64_t>(x) & exponent) != exponent;
}

inline bool is_finite(const Vec3& x) noexcept { return is_finite(x[0]) && is_finite(x[1]) && is_finite(x[2]); }

/// The largest length, coordinate or slide that is taken (model unit; about 1e301): chains of four million of them, and
/// boxes around what they place, stay below the largest double, 2^1024, so that nothing infinite is ever computed.
inline constexpr double largest_length = 0x1p1000;

/// Finite, and no larger than largest_length on either side of 0?
inline bool is_length(double x) noexcept {
  constexpr std::uint64_t magnitude = 0x7fff'ffff'ffff'ffffULL;
  return (std::bit_cast<std::uint64_t>(x) & magnitude) <= std::bit_cast<std::uint64_t>(largest_length);
}

inline bool is_length(const Vec3& x) noexcept { return is_length(x[0]) && is_length(x[1]) && is_length(x[2]); }

}  // namespace hinge
