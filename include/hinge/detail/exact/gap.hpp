// SPDX-License-Identifier: BSD-3-Clause
// Compares a length, known by its square, with a sum of radii in exact integers: the last stage of d < M.
#pragma once

#include <algorithm>
#include <cmath>

#include "hinge/core/finite.hpp"
#include "hinge/core/radius_sum.hpp"
#include "hinge/detail/core/assert.hpp"
#include "hinge/detail/exact/integer.hpp"
#include "hinge/detail/exact/orient.hpp"

namespace hinge::detail::exact {

/// Returns the largest exponent e <= unit for which every term of the sum is a multiple of 2^e.
inline int common_unit(const RadiusSum& sum, int unit) noexcept {
  return std::min({unit, unit_exponent(sum.first, no_unit), unit_exponent(sum.second, no_unit),
                   unit_exponent(sum.clearance, no_unit)});
}

/// Returns the sum in units of 2^unit. `unit` comes from common_unit().
inline Integer whole(const RadiusSum& sum, int unit) noexcept {
  return Integer::of(sum.first, unit) + Integer::of(sum.second, unit) + Integer::of(sum.clearance, unit);
}

/// Returns true when the squared length numerator / denominator is below reach^2, or equal to it when touching counts.
inline bool within(const Integer& numerator, const Integer& denominator, const Integer& reach,
                   bool counts_touching) noexcept {
  const Integer square = reach * reach * denominator;
  return counts_touching ? numerator <= square : numerator < square;
}

/// Returns (length - reach)^2, where length^2 = numerator / denominator. The relative error is at most 16 u; the result
/// is exactly 0 when length <= reach. It starts from the exact length^2 - reach^2, because the difference of the
/// lengths would lose digits by cancellation.
inline Scaled squared_gap(const Integer& numerator, const Integer& denominator, const Integer& reach) noexcept {
  const Integer excess = numerator - reach * reach * denominator;
  if (excess.sign() <= 0) return {};
  const Scaled below = denominator.scaled();
  const Scaled squared = numerator.scaled() / below;
  if (reach.sign() == 0) return squared;
  const Scaled length = sqrt(squared);
  const Scaled other = reach.scaled();  // smaller than the length
  Scaled sum = length;
  sum.mantissa += std::ldexp(other.mantissa, std::max(other.exponent - length.exponent, -2000));
  const Scaled gap = (excess.scaled() / below) / Scaled{sum.mantissa, sum.exponent};
  return {gap.mantissa * gap.mantissa, 2 * gap.exponent};
}

/// Converts from units of 2^(2 unit) to double: infinite above the largest double, and nonzero for every nonzero value.
inline double to_double(const Scaled& squared, int unit) noexcept {
  constexpr double smallest = 0x1p-1074;
  return squared.mantissa == 0.0 ? 0.0 : std::max(squared.value(2 * unit), smallest);
}

}  // namespace hinge::detail::exact
