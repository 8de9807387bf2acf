// SPDX-License-Identifier: BSD-3-Clause
// Two closed balls, or two points, in whole numbers: the verdict and the gap for the real numbers that the doubles are.
#pragma once

#include <array>

#include "hinge/core/finite.hpp"
#include "hinge/core/radius_sum.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/exact/gap.hpp"
#include "hinge/detail/exact/integer.hpp"
#include "hinge/detail/exact/orient.hpp"

namespace hinge::detail::exact {

/// |p - q|^2 and the reach in one unit, a power of two.
struct WholeBalls {
  WholeBalls(const Vec3& p, const Vec3& q, const RadiusSum& r) noexcept {
    const std::array<Vec3, 2> centres{p, q};
    unit = common_unit(r, common_unit(centres));
    if (unit == no_unit) unit = 0;
    const WholePoint apart = whole_difference(p, q, unit);
    squared = dot(apart, apart);
    reach = exact::whole(r, unit);
  }
  int unit = 0;
  Integer squared, reach;
};

/// Strictly |p - q| < m. Finite p and q, any m.
[[gnu::cold, gnu::noinline]] inline bool points_closer_than(const Vec3& p, const Vec3& q, double m) noexcept {
  if (!(m > 0.0)) return false;
  if (!is_finite(m)) return true;
  const WholeBalls whole(p, q, RadiusSum{0.0, 0.0, m});
  return whole.squared < whole.reach * whole.reach;
}

/// |p - q| < the reach, or |p - q| <= the radii where there is no clearance. Finite p, q and radii.
[[gnu::cold, gnu::noinline]] inline bool balls_closer_than(const Vec3& p, const Vec3& q,
                                                           const RadiusSum& reach) noexcept {
  if (!is_finite(reach.clearance)) return true;
  const WholeBalls whole(p, q, reach);
  return within(whole.squared, Integer::of(1.0, 0), whole.reach, reach.counts_touching());
}

/// (|p - q| - reach)^2, 0 exactly when the balls meet; right to 16 half ulps where it is a normal double, infinite
/// above the largest.
[[gnu::cold, gnu::noinline]] inline double squared_gap_of_balls(const Vec3& p, const Vec3& q,
                                                                const RadiusSum& reach) noexcept {
  const WholeBalls whole(p, q, reach);
  return to_double(squared_gap(whole.squared, Integer::of(1.0, 0), whole.reach), whole.unit);
}

}  // namespace hinge::detail::exact
