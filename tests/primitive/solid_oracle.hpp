// SPDX-License-Identifier: BSD-3-Clause
// Points, spheres and capsules in rationals (Boost.Multiprecision). The squared distance of two segments comes from
// the Gram matrix of their directions and is compared with sums of radii. Shares neither code nor formulas with the
// library.
#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"

namespace hinge::test {

/// Two primitives of one kind as segments with radii, in integer multiples of 2^unit.
class SolidOracle {
 public:
  using Big = boost::multiprecision::cpp_int;
  using Float50 = boost::multiprecision::cpp_bin_float_50;

  SolidOracle(const Point& p, const Point& q)
      : SolidOracle(Capsule{p.position, p.position, 0.0}, {q.position, q.position, 0.0}) {}
  SolidOracle(const Sphere& p, const Sphere& q)
      : SolidOracle(Capsule{p.center, p.center, p.radius}, {q.center, q.center, q.radius}) {}
  SolidOracle(const Capsule& p, const Capsule& q) {
    const std::array<const Vec3*, 4> ends{&p.a, &p.b, &q.a, &q.b};
    unit_ = std::min(lowest(p.radius), lowest(q.radius));
    for (const Vec3* end : ends)
      for (int k = 0; k < 3; ++k) unit_ = std::min(unit_, lowest((*end)[k]));
    std::array<Vector, 4> x;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        x[i][k] = in_units((*ends[i])[static_cast<int>(k)]);
        for (std::size_t j = 0; j <= i; ++j) {
          const Big difference = abs(Big(x[i][k] - x[j][k]));
          largest_ = std::max(largest_, difference);
        }
      }
    radii_ = in_units(p.radius) + in_units(q.radius);
    const Vector u = minus(x[1], x[0]), v = minus(x[3], x[2]), w = minus(x[0], x[2]);
    const Big uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), uw = dot(u, w), vw = dot(v, w), ww = dot(w, w);
    // Minimum of |w + s u - t v|^2 over the unit square of (s, t): candidates are its corners, its edges and its
    // interior.
    for (const int s : {0, 1})
      for (const int t : {0, 1}) take(ww + s * (uu + 2 * uw) + t * (vv - 2 * vw) - 2 * s * t * uv, 1);
    for (const int s : {0, 1}) {
      const Big along = vw + s * uv, rest = ww + s * (uu + 2 * uw);  // as a function of t
      if (along > 0 && along < vv) take(rest * vv - along * along, vv);
    }
    for (const int t : {0, 1}) {
      const Big along = t * uv - uw, rest = ww + t * (vv - 2 * vw);  // as a function of s
      if (along > 0 && along < uu) take(rest * uu - along * along, uu);
    }
    const Big det = uu * vv - uv * uv, s = uv * vw - vv * uw, t = uu * vw - uv * uw;
    if (det > 0 && s > 0 && s < det && t > 0 && t < det) take(ww * det + s * uw - t * vw, det);
  }

  /// Whether the closed solids share a point.
  bool meet() const { return numerator_ <= radii_ * radii_ * denominator_; }

  /// Whether the gap is less than m, for m > 0.
  bool below(double m) const {
    const int shift = std::max(unit_ - lowest(m), 0);
    const Big reach = (radii_ << static_cast<unsigned>(shift)) +
                      (mantissa(m) << static_cast<unsigned>(std::max(lowest(m) - unit_, 0)));
    return (numerator_ << static_cast<unsigned>(2 * shift)) < reach * reach * denominator_;
  }

  /// Distance of the segments and of the surfaces (negative for an overlap), to about 45 digits.
  Float50 between() const { return ldexp(root(), unit_); }
  Float50 gap() const {
    const Float50 excess(Big(numerator_ - radii_ * radii_ * denominator_));
    return excess == 0 ? Float50(0)
                       : Float50(ldexp(excess / (Float50(denominator_) * (root() + Float50(radii_))), unit_));
  }
  Float50 largest_difference() const { return ldexp(Float50(largest_), unit_); }

 private:
  using Vector = std::array<Big, 3>;

  static int exponent_of(double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return exponent - 53;
  }
  /// The exponent e of a power 2^e that divides x: that of the last of its 53 digits, at least -1074.
  static int lowest(double x) { return x == 0.0 ? 0 : std::max(exponent_of(x), -1074); }
  static Big mantissa(double x) { return x == 0.0 ? 0 : Big(static_cast<std::int64_t>(std::ldexp(x, -lowest(x)))); }
  Big in_units(double x) const { return x == 0.0 ? 0 : mantissa(x) << static_cast<unsigned>(lowest(x) - unit_); }

  static Big dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  Float50 root() const { return sqrt(Float50(numerator_) / Float50(denominator_)); }

  void take(const Big& numerator, const Big& denominator) {
    if (found_ && numerator * denominator_ >= numerator_ * denominator) return;
    found_ = true;
    numerator_ = numerator;
    denominator_ = denominator;
  }

  int unit_ = 0;
  bool found_ = false;
  Big numerator_ = 0, denominator_ = 1, radii_ = 0, largest_ = 0;
};

}  // namespace hinge::test
