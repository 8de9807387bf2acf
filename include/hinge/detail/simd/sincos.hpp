// SPDX-License-Identifier: BSD-3-Clause
// Sine and cosine of eight angles at once, with the bits of the scalar functions.
#pragma once

#include <array>
#include <cstddef>

#include "hinge/detail/core/sincos.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail::simd {

/// Computes sincos per lane, for |angle| <= cody_waite_limit.
[[gnu::always_inline]] inline void sincos(const Double8& angle, Double8& sine, Double8& cosine) noexcept {
  Double8 n, high, low, s, c;
  reduce_parts(angle, n, high, low);
  sincos_of_reduced(high, low, s, c);
  // The quadrant is n modulo 4: n / 4 - 3 / 8 rounds to floor(n / 4).
  const Double8 rounder(detail::rounder);
  const Double8 q = n - Double8(4.0) * (((n * Double8(0.25) - Double8(0.375)) + rounder) - rounder);
  const Double8 odd = abs(abs(q - Double8(2.0)) - Double8(1.0)), half(0.5);  // 0 in quadrants 1 and 3, otherwise 1
  const Double8 first = choose_less(odd, half, c, s), second = choose_less(odd, half, s, c);
  sine = choose_less(q, Double8(1.5), first, -first);
  cosine = choose_less(abs(q - Double8(1.5)), Double8(1.0), -second, second);
}

/// Computes sincos per lane for any finite angles. small: no |angle| exceeds cody_waite_limit.
[[gnu::always_inline]] inline void sincos(const double* angle, bool small, Double8& sine, Double8& cosine) noexcept {
  if (small) return sincos(Double8(angle), sine, cosine);
  std::array<double, 8> sines, cosines;
  for (std::size_t k = 0; k < 8; ++k) {
    const SinCos sc = detail::sincos(angle[k]);
    sines[k] = sc.sin;
    cosines[k] = sc.cos;
  }
  sine = Double8(sines.data());
  cosine = Double8(cosines.data());
}

}  // namespace hinge::detail::simd
