// SPDX-License-Identifier: BSD-3-Clause
// Two closed balls, or two points, in exact integer arithmetic: the collision decision and the gap.
#pragma once

#include <array>

#include "hinge/core/finite.hpp"
#include "hinge/core/radius_sum.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/exact/gap.hpp"
#include "hinge/detail/exact/integer.hpp"
#include "hinge/detail/exact/orient.hpp"

namespace hinge::detail::exact {

/// |p - q|^2 and the radius sum in units of a power of two.
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

/// Returns true when strictly |p - q| < m. p and q finite, any m.
[[gnu::cold, gnu::noinline]] inline bool points_closer_than(const Vec3& p, const Vec3& q, double m) noexcept {
  if (!(m > 0.0)) return false;
  if (!is_finite(m)) return true;
  const WholeBalls whole(p, q, RadiusSum{0.0, 0.0, m});
  return whole.squared < whole.reach * whole.reach;
}

/// Returns true when |p - q| < reach or, without a clearance, |p - q| <= the sum of the radii. p, q and the radii
/// finite.
[[gnu::cold, gnu::noinline]] inline bool balls_closer_than(const Vec3& p, const Vec3& q,
                                                           const RadiusSum& reach) noexcept {
  if (!is_finite(reach.clearance)) return true;
  const WholeBalls whole(p, q, reach);
  return within(whole.squared, Integer::of(1.0, 0), whole.reach, reach.counts_touching());
}

/// Returns (|p - q| - reach)^2, exactly 0 when the balls share a point. The relative error is at most 16 u (u = 2^-53)
/// where the result is a normal double. It is infinite above the largest double.
[[gnu::cold, gnu::noinline]] inline double squared_gap_of_balls(const Vec3& p, const Vec3& q,
                                                                const RadiusSum& reach) noexcept {
  const WholeBalls whole(p, q, reach);
  return to_double(squared_gap(whole.squared, Integer::of(1.0, 0), whole.reach), whole.unit);
}

}  // namespace hinge::detail::exact
