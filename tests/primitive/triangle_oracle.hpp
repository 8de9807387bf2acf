// SPDX-License-Identifier: BSD-3-Clause
// The distance of two closed triangles in rationals (Boost.Multiprecision): the smallest feasible stationary value
// over all pairs of faces of the two simplices, by Gram systems. Shares neither code nor formulas with the library.
#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/primitive/triangle.hpp"

namespace hinge::test {

using Big = boost::multiprecision::cpp_int;
using Float50 = boost::multiprecision::cpp_bin_float_50;

/// Coordinates are integer multiples of 2^unit.
class OracleDistance {
 public:
  OracleDistance(const Triangle& x, const Triangle& y) {
    const std::array<const Vec3*, 6> points{&x.a, &x.b, &x.c, &y.a, &y.b, &y.c};
    unit_ = 1100;
    for (const Vec3* p : points)
      for (int k = 0; k < 3; ++k)
        if ((*p)[k] != 0.0) unit_ = std::min(unit_, lowest((*p)[k]));
    std::array<Point, 6> whole;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t k = 0; k < 3; ++k) whole[i][k] = in_units((*points[i])[static_cast<int>(k)]);
    for (const auto& a : faces())
      for (const auto& b : faces()) take_stationary(whole, a, b);
  }

  bool meet() const { return numerator_ == 0; }

  /// Whether d < m, both as real numbers.
  bool below(double m) const {
    if (!(m > 0.0)) return false;
    const int shift = lowest(m) - unit_;
    Big left = numerator_, whole = static_cast<std::int64_t>(std::ldexp(m, -lowest(m)));
    if (shift >= 0)
      whole <<= static_cast<unsigned>(shift);
    else
      left <<= static_cast<unsigned>(-2 * shift);
    return left < whole * whole * denominator_;
  }

  /// Accurate to 50 digits.
  Float50 distance() const { return ldexp(sqrt(Float50(numerator_) / Float50(denominator_)), unit_); }

 private:
  using Point = std::array<Big, 3>;

  static int lowest(double x) {
    int exponent = 0;
    auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    exponent -= 53;
    for (; mantissa % 2 == 0; mantissa /= 2) ++exponent;
    return exponent;
  }

  Big in_units(double x) const {
    if (x == 0.0) return 0;
    const int low = lowest(x);
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(x, -low));
    return Big(mantissa) << static_cast<unsigned>(low - unit_);
  }

  static const std::vector<std::vector<std::size_t>>& faces() {
    static const std::vector<std::vector<std::size_t>> all{{0}, {1}, {2}, {0, 1}, {1, 2}, {2, 0}, {0, 1, 2}};
    return all;
  }

  static Big dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

  using Matrix = std::vector<std::vector<Big>>;
  static Big determinant(const Matrix& m) {
    if (m.empty()) return 1;
    if (m.size() == 1) return m[0][0];
    if (m.size() == 2) return m[0][0] * m[1][1] - m[0][1] * m[1][0];
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }

  /// Takes the stationary point of |w + sum share_i edge_i| by Cramer's rule if its shares are in both simplices. For
  /// a singular system, smaller faces have the same minimum; two crossing faces also cross at an edge.
  void take_stationary(const std::array<Point, 6>& p, const std::vector<std::size_t>& a,
                       const std::vector<std::size_t>& b) {
    std::vector<Point> edges;
    for (std::size_t i = 1; i < a.size(); ++i) edges.push_back(minus(p[a[i]], p[a[0]]));
    for (std::size_t i = 1; i < b.size(); ++i) edges.push_back(minus(p[3 + b[0]], p[3 + b[i]]));
    const std::size_t n = edges.size();
    if (n > 3) return;
    const Point w = minus(p[a[0]], p[3 + b[0]]);
    Matrix gram(n, std::vector<Big>(n));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) gram[i][j] = dot(edges[i], edges[j]);
    const Big det = determinant(gram);
    if (det == 0) return;
    std::array<Big, 2> sums{0, 0};
    Big numerator = dot(w, w) * det;
    for (std::size_t i = 0; i < n; ++i) {
      Matrix replaced = gram;
      for (std::size_t j = 0; j < n; ++j) replaced[j][i] = -dot(w, edges[j]);
      const Big share = determinant(replaced);
      if (share < 0) return;
      Big& sum = sums[i < a.size() - 1 ? 0 : 1];
      sum += share;
      if (sum > det) return;
      numerator += share * dot(w, edges[i]);
    }
    if (found_ && numerator * denominator_ >= numerator_ * det) return;
    found_ = true;
    numerator_ = numerator;
    denominator_ = det;
  }

  int unit_ = 0;
  bool found_ = false;
  Big numerator_ = 0, denominator_ = 1;
};

}  // namespace hinge::test
