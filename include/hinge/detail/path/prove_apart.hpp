// SPDX-License-Identifier: BSD-3-Clause
// prove_apart: finds how long two primitives surely keep a distance, from their relative motion.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/path/relative_motion.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Radii around the middle of a segment, towards smaller and larger parameters t.
struct ProvedRadii {
  double before = 0.0;
  double after = 0.0;
};

/// Corners of a primitive projected on a direction: at(s) = value + s rate. radius: their largest distance from
/// `reference`.
template <std::size_t N>
struct CornersAlong {
  std::array<double, N> value, rate;
  double radius = 0.0;

  CornersAlong(const std::array<Vec3, N>& hull, double scale, const Vec3& along, const Vec3& reference,
               const Twist& twist) noexcept {
    for (std::size_t k = 0; k < N; ++k) {
      const Vec3 x = hull[k] * scale;
      value[k] = dot(along, x);
      rate[k] = dot(along, twist.at(x));
      radius = std::max(radius, norm(Vec3(x - reference)));
    }
  }
  double smallest(double s) const noexcept {
    double r = value[0] + s * rate[0];
    for (std::size_t k = 1; k < N; ++k) r = std::min(r, value[k] + s * rate[k]);
    return r;
  }
  double largest(double s) const noexcept {
    double r = value[0] + s * rate[0];
    for (std::size_t k = 1; k < N; ++k) r = std::max(r, value[k] + s * rate[k]);
    return r;
  }
};

/// True if p and q (points with a radius) stay at least m apart when they approach by `closer` (scaled). False if
/// rounding of this sum leaves it open.
template <Certifiable P>
requires(hull_size<P> == 1) bool farther_than(const P& p, const P& q, double m, double closer, double scale) noexcept {
  const double least = ((p.hull_radius() + q.hull_radius() + m) * scale + closer) * (1.0 + 0x1p-40);
  return squared_norm(Vec3((q.hull()[0] - p.hull()[0]) * scale)) > least * least * (1.0 + 0x1p-40);
}

/// The same for two points at least `least` apart, model length unit.
inline bool farther_than(double least, double m, double closer, double scale) noexcept {
  return least * scale > (m * scale + closer) * (1.0 + 0x1p-40);
}

/// Returns the radii around the middle, at most `half`, within which placed p and q surely stay at least m apart. p and
/// q are given at the middle. All comparisons fail for NaN: the radii are 0 then.
template <Certifiable P>
ProvedRadii prove_apart(const P& p, const P& q, double m, const RelativeMotion& motion, double half,
                        double scale) noexcept {
  const auto x = p.hull(), y = q.hull();
  constexpr std::size_t n = std::tuple_size_v<decltype(p.hull())>;
  Vec3 along;
  if constexpr (n == 1) {
    along = (y[0] - x[0]) * scale;
  } else {
    const auto [from, to] = closest_points(p, q);
    along = (to - from) * scale;
  }
  const double length = norm(along);
  if (!(length > 0.0)) return {};
  along /= length;
  const CornersAlong<n> a(x, scale, along, motion.first_point, motion.first),
      b(y, scale, along, motion.second_point, motion.second);
  // m may be a rounded sum.
  const double less = (p.hull_radius() + q.hull_radius() + m) * (1.0 + 0x1p-50) * scale + motion.rounding;
  if (!(b.smallest(0.0) - a.largest(0.0) - less > 0.0)) return {};
  const double second = (motion.points + motion.first_unit * a.radius + motion.second_unit * b.radius) * bound_above;
  const double bend = 0.5 * second * half * half;
  const auto radius = [&](double sign) {
    if (b.smallest(sign * half) - a.largest(sign * half) - less - bend >= 0.0) return half;
    double shortest = half;
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t l = 0; l < n; ++l) {
        // Smaller root of gap + rate s - second s^2 / 2, computed without cancellation, rounded down.
        const double gap = b.value[l] - a.value[k] - less, rate = sign * (b.rate[l] - a.rate[k]);
        const double root = 2.0 * gap / (std::sqrt(rate * rate + 2.0 * second * gap) - rate);
        if (!(root * (1.0 - 0x1p-40) >= shortest)) shortest = root * (1.0 - 0x1p-40);
      }
    return shortest >= 0.0 ? shortest : 0.0;
  };
  return {radius(-1.0), radius(1.0)};
}

}  // namespace hinge::detail
