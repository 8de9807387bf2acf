// SPDX-License-Identifier: BSD-3-Clause
// Lengths whose squares are fractions of whole numbers against sums of radii: the last rung of d < M.
#pragma once

#include <algorithm>
#include <cmath>

#include "hinge/core/finite.hpp"
#include "hinge/core/radius_sum.hpp"
#include "hinge/detail/core/assert.hpp"
#include "hinge/detail/exact/integer.hpp"
#include "hinge/detail/exact/orient.hpp"

namespace hinge::detail::exact {

/// The largest exponent e, not above `unit`, of which each term of the sum is a whole multiple of 2^e.
inline int common_unit(const RadiusSum& sum, int unit) noexcept {
  return std::min({unit, unit_exponent(sum.first, no_unit), unit_exponent(sum.second, no_unit),
                   unit_exponent(sum.clearance, no_unit)});
}

/// The sum in units of 2^unit, which common_unit() gave.
inline Integer whole(const RadiusSum& sum, int unit) noexcept {
  return Integer::of(sum.first, unit) + Integer::of(sum.second, unit) + Integer::of(sum.clearance, unit);
}

/// Does a squared length, a fraction, fall short of reach^2, or reach it where touching counts?
inline bool within(const Integer& numerator, const Integer& denominator, const Integer& reach,
                   bool counts_touching) noexcept {
  const Integer square = reach * reach * denominator;
  return counts_touching ? numerator <= square : numerator < square;
}

/// (length - reach)^2 for the length whose square is the fraction: right to 16 half ulps, 0 exactly when the length
/// does not exceed the reach. From length^2 - reach^2, which is known exactly, as subtracting the lengths would cancel.
inline Scaled squared_gap(const Integer& numerator, const Integer& denominator, const Integer& reach) noexcept {
  const Integer excess = numerator - reach * reach * denominator;
  if (excess.sign() <= 0) return {};
  const Scaled below = denominator.scaled();
  const Scaled squared = numerator.scaled() / below;
  if (reach.sign() == 0) return squared;
  const Scaled length = sqrt(squared);
  const Scaled other = reach.scaled();  // below the length
  Scaled sum = length;
  sum.mantissa += std::ldexp(other.mantissa, std::max(other.exponent - length.exponent, -2000));
  const Scaled gap = (excess.scaled() / below) / Scaled{sum.mantissa, sum.exponent};
  return {gap.mantissa * gap.mantissa, 2 * gap.exponent};
}

/// In units of 2^(2 unit), as a double: infinite above the largest, and never 0 for what is not.
inline double to_double(const Scaled& squared, int unit) noexcept {
  constexpr double smallest = 0x1p-1074;
  return squared.mantissa == 0.0 ? 0.0 : std::max(squared.value(2 * unit), smallest);
}

}  // namespace hinge::detail::exact
