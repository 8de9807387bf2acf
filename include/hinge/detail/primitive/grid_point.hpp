// SPDX-License-Identifier: BSD-3-Clause
// GridPoint: an atom at whole multiples of a thousandth, as files give it; ties that are decimal are decided as such.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/bounds/round.hpp"
#include "hinge/detail/exact/error_free.hpp"
#include "hinge/detail/exact/integer.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge::detail {

/// 1.001 is no double, so the doubles read from a file are not the coordinates in it, and of pairs exactly at their
/// threshold about half fall on either side. Here coordinates are integers and no pair does. For atoms where a file
/// puts them: a moved one is rounded to the grid again, as if it had been written to such a file, so a pose changes
/// distances, by less than two thousandths.
struct GridPoint {
  static constexpr double per_unit = 1000.0;  ///< PDB and mmCIF: three decimals of an angstrom
  /// In thousandths of the model unit. Up to 2^40, so that squares times 10^12 have less than 127 bits.
  static constexpr std::int64_t most = std::int64_t{1} << 40;

  std::array<std::int64_t, 3> thousandths{};

  /// The point whose three decimals x was read from; none where x is no double nearest to a thousandth.
  static std::optional<GridPoint> of(const Vec3& x) noexcept {
    const GridPoint p = nearest(x);
    if (!is_finite(x) || p.position() != x) return std::nullopt;
    return p;
  }

  /// The nearest doubles: what a correct reader makes of the decimals.
  Vec3 position() const noexcept {
    return {static_cast<double>(thousandths[0]) / per_unit, static_cast<double>(thousandths[1]) / per_unit,
            static_cast<double>(thousandths[2]) / per_unit};
  }

  GridPoint placed(const Pose& pose) const noexcept { return nearest(pose * position()); }

  /// Around the decimals, which are not the doubles.
  Aabb bounds() const noexcept {
    const Vec3 x = position();
    return {Vec3(next_down(x[0]), next_down(x[1]), next_down(x[2])), Vec3(next_up(x[0]), next_up(x[1]), next_up(x[2]))};
  }

  /// Right to 4 half ulps, 0 exactly when the points coincide.
  friend double squared_distance(const GridPoint& p, const GridPoint& q) noexcept {
    return squared_norm(p.apart(q)) / (per_unit * per_unit);
  }

  /// Strictly d < m in decimals: m stands for the nearest number of at most nine decimals where that is within 16 half
  /// ulps, which is what a threshold computed from decimals is meant to be; else for itself.
  friend bool closer_than(const GridPoint& p, const GridPoint& q, double m) noexcept {
    // Half ulps: 3 for the sum of squares, 3 for the square of a product, 32 for what m stands for, 1 for the band.
    // Nothing underflows: squares of whole numbers are 0 or at least 1. What is infinite is below nothing.
    constexpr double band = 1.0 + 64 * exact::half_ulp;
    const double near = m * per_unit, square = near * near, squared = squared_norm(p.apart(q));
    if (square * band < squared) return false;
    if (squared * band < square) return true;
    return p.closer_in_decimals(q, m);
  }

 private:
  __extension__ using Simd = __int128;

  /// What is out of range becomes its end, which no x is read from.
  static GridPoint nearest(const Vec3& x) noexcept {
    GridPoint p;
    for (std::size_t k = 0; k < 3; ++k) {
      const double at = std::nearbyint(x[static_cast<int>(k)] * per_unit);
      constexpr auto end = static_cast<double>(most);
      // Neither is NaN, which is refused long before.
      p.thousandths[k] = at >= end ? most : at > -end ? static_cast<std::int64_t>(at) : -most;
    }
    return p;
  }

  /// Differences, whole numbers that doubles hold.
  Vec3 apart(const GridPoint& q) const noexcept {
    return {static_cast<double>(thousandths[0] - q.thousandths[0]),
            static_cast<double>(thousandths[1] - q.thousandths[1]),
            static_cast<double>(thousandths[2] - q.thousandths[2])};
  }

  [[gnu::cold, gnu::noinline]] bool closer_in_decimals(const GridPoint& q, double m) const noexcept {
    constexpr double billion = 1e9, largest = 0x1p62;
    if (!(m > 0.0)) return false;
    Simd squared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Simd d = thousandths[k] - q.thousandths[k];
      squared += d * d;
    }
    const double scaled = m * billion, whole = std::nearbyint(scaled);
    // The product is off by a half ulp.
    if (scaled < largest && std::abs(scaled - whole) <= 17 * exact::half_ulp * scaled) {
      const Simd n = static_cast<std::int64_t>(whole), million = 1'000'000;
      return squared * million * million < n * n;
    }
    if (!is_finite(m)) return true;
    // m^2 10^6 in units of 2^(2 unit).
    const int unit = exact::unit_exponent(m, 0) < 0 ? exact::unit_exponent(m, 0) : 0;
    exact::Integer left;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto d = exact::Integer::of(static_cast<double>(thousandths[k] - q.thousandths[k]), unit);
      left = left + d * d;
    }
    const auto right = exact::Integer::of(m, unit) * exact::Integer::of(per_unit, 0);
    return left < right * right;
  }
};

static_assert(Primitive<GridPoint>);

/// Strictly d < m for points where a file put them: in decimals when both are on the grid, else for the doubles.
inline bool closer_as_written(const Point& p, const Point& q, double m) noexcept {
  const std::optional<GridPoint> a = GridPoint::of(p.position), b = GridPoint::of(q.position);
  return a && b ? closer_than(*a, *b, m) : closer_than(p, q, m);
}

}  // namespace hinge::detail
