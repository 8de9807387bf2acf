// SPDX-License-Identifier: BSD-3-Clause
// Finiteness by bit pattern: std::isfinite is folded to true under -ffast-math.
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

}  // namespace hinge
