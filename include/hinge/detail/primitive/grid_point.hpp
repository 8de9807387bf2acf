// SPDX-License-Identifier: BSD-3-Clause
// GridPoint: an atom on a grid of 0.001 length units, as in PDB and mmCIF files. Decimal ties are decided exactly.
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

/// A decimal such as 1.001 is not a double, so the doubles read from a file differ from its coordinates, and a pair
/// exactly at its threshold may fall on either side. Here coordinates are integers, so a tie stays a tie. Use it for
/// atoms at their file coordinates. A transformed atom is rounded to the grid again, as if written to a file; a pose
/// thus changes distances by less than 0.002.
struct GridPoint {
  static constexpr double per_unit = 1000.0;  ///< PDB and mmCIF: three decimals of an angstrom
  /// Largest magnitude, in thousandths of the model unit. With 2^40 the squares times 10^12 have less than 127 bits.
  static constexpr std::int64_t most = std::int64_t{1} << 40;

  std::array<std::int64_t, 3> thousandths{};

  /// Returns the grid point whose decimals read as x, or nullopt when x is not the nearest double of a grid point.
  static std::optional<GridPoint> of(const Vec3& x) noexcept {
    const GridPoint p = nearest(x);
    if (!is_finite(x) || p.position() != x) return std::nullopt;
    return p;
  }

  /// Returns the nearest doubles of the coordinates: the result of a correct reader.
  Vec3 position() const noexcept {
    return {static_cast<double>(thousandths[0]) / per_unit, static_cast<double>(thousandths[1]) / per_unit,
            static_cast<double>(thousandths[2]) / per_unit};
  }

  GridPoint placed(const Pose& pose) const noexcept { return nearest(pose * position()); }

  /// Returns a box that contains the exact decimal coordinates, which are not doubles.
  Aabb bounds() const noexcept {
    const Vec3 x = position();
    return {Vec3(next_down(x[0]), next_down(x[1]), next_down(x[2])), Vec3(next_up(x[0]), next_up(x[1]), next_up(x[2]))};
  }

  /// Returns the squared distance with a relative error of at most 4 u; 0 exactly when the points coincide.
  friend double squared_distance(const GridPoint& p, const GridPoint& q) noexcept {
    return squared_norm(p.apart(q)) / (per_unit * per_unit);
  }

  /// Returns true when strictly d < m in decimals. m means the nearest decimal with nine digits after the point when
  /// that is within 16 half ulps, because thresholds are usually computed from decimals; otherwise m means itself.
  friend bool closer_than(const GridPoint& p, const GridPoint& q, double m) noexcept {
    // Roundings in half ulps: 3 for the sum of squares, 3 for the square of a product, 32 for the meaning of m, 1 for
    // the band. Nothing underflows: squares of integers are 0 or at least 1. The comparisons are false when the left
    // side is infinite.
    constexpr double band = 1.0 + 64 * exact::half_ulp;
    const double near = m * per_unit, square = near * near, squared = squared_norm(p.apart(q));
    if (square * band < squared) return false;
    if (squared * band < square) return true;
    return p.closer_in_decimals(q, m);
  }

 private:
  __extension__ using Wide = __int128;

  /// Returns the nearest grid point. Coordinates out of range become the largest value, which no valid x equals.
  static GridPoint nearest(const Vec3& x) noexcept {
    GridPoint p;
    for (std::size_t k = 0; k < 3; ++k) {
      const double at = std::nearbyint(x[static_cast<int>(k)] * per_unit);
      constexpr auto end = static_cast<double>(most);
      // The last case also receives NaN, but NaN is rejected by callers.
      p.thousandths[k] = at >= end ? most : at > -end ? static_cast<std::int64_t>(at) : -most;
    }
    return p;
  }

  /// Returns the difference in thousandths: integers that a double holds exactly.
  Vec3 apart(const GridPoint& q) const noexcept {
    return {static_cast<double>(thousandths[0] - q.thousandths[0]),
            static_cast<double>(thousandths[1] - q.thousandths[1]),
            static_cast<double>(thousandths[2] - q.thousandths[2])};
  }

  [[gnu::cold, gnu::noinline]] bool closer_in_decimals(const GridPoint& q, double m) const noexcept {
    constexpr double billion = 1e9, largest = 0x1p62;
    if (!(m > 0.0)) return false;
    Wide squared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Wide d = thousandths[k] - q.thousandths[k];
      squared += d * d;
    }
    const double scaled = m * billion, whole = std::nearbyint(scaled);
    // The product m * billion has an error of half an ulp.
    if (scaled < largest && std::abs(scaled - whole) <= 17 * exact::half_ulp * scaled) {
      const Wide n = static_cast<std::int64_t>(whole), million = 1'000'000;
      return squared * million * million < n * n;
    }
    if (!is_finite(m)) return true;
    // Compare squared distances with m^2 10^6, in units of 2^(2 unit).
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

/// Returns true when strictly d < m for points at their file coordinates: in decimals when both are on the grid,
/// otherwise for the stored doubles.
inline bool closer_as_written(const Point& p, const Point& q, double m) noexcept {
  const std::optional<GridPoint> a = GridPoint::of(p.position), b = GridPoint::of(q.position);
  return a && b ? closer_than(*a, *b, m) : closer_than(p, q, m);
}

}  // namespace hinge::detail
