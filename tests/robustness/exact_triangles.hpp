// SPDX-License-Identifier: BSD-3-Clause
// True answers for two sets of placed triangles: extended precision rules out pairs, rationals decide the others.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "hinge/primitive/triangle.hpp"
#include "primitive/triangle_oracle.hpp"
#include "robustness/case.hpp"
#include "robustness/exact_atoms.hpp"

namespace hinge::test {

using Extended = std::array<long double, 3>;

inline long double dot(const Extended& a, const Extended& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Returns a + s b.
inline Extended plus(const Extended& a, long double s, const Extended& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

/// Two triangles relative to the first corner of the first, with rigorous bounds of their distance.
class ExtendedPair {
 public:
  ExtendedPair(const Triangle& x, const Triangle& y) {
    const std::array<const Vec3*, 6> corners{&x.a, &x.b, &x.c, &y.a, &y.b, &y.c};
    for (std::size_t i = 0; i < 6; ++i)
      for (int k = 0; k < 3; ++k) {
        const long double c = static_cast<long double>((*corners[i])[k]) - x.a[k];
        corner_[i / 3][i % 3][static_cast<std::size_t>(k)] = c;
        size_ = std::max(size_, std::abs(c));
      }
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t l = 0; l < 3; ++l) look_at_edges(k, l);
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t k = 0; k < 3; ++k) look_at_face(side, k);
  }

  long double lower() const { return lower_; }
  long double upper() const { return upper_; }

 private:
  /// Updates the bounds with direction d, a difference of points of the triangles. Its length is an upper bound; the
  /// gap of the corners' projections onto it is a lower bound. 64 half epsilons cover the roundings: per triangle 6 for
  /// a corner or a convex combination of corners, 5 for a dot product, 3 for a norm.
  void look_along(const Extended& d) {
    const long double length = std::sqrt(dot(d, d));
    const long double doubt = 32 * std::numeric_limits<long double>::epsilon() * size_;
    upper_ = std::min(upper_, length + doubt);
    if (!(length > 0)) return;
    std::array<long double, 2> low, high;
    for (std::size_t side = 0; side < 2; ++side) {
      const auto along = [&](std::size_t k) { return dot(corner_[side][k], d) / length; };
      low[side] = std::min({along(0), along(1), along(2)});
      high[side] = std::max({along(0), along(1), along(2)});
    }
    lower_ = std::max(lower_, std::max(low[0] - high[1], low[1] - high[0]) - doubt);
  }

  static long double share(long double part, long double whole) {
    return whole > 0 ? std::clamp(part / whole, 0.0L, 1.0L) : 0.0L;
  }

  void look_at_edges(std::size_t k, std::size_t l) {
    const Extended &p = corner_[0][k], &q = corner_[1][l];
    const Extended u = plus(corner_[0][(k + 1) % 3], -1, p), v = plus(corner_[1][(l + 1) % 3], -1, q),
                   r = plus(p, -1, q);
    const long double a = dot(u, u), b = dot(u, v), c = dot(u, r), e = dot(v, v), f = dot(v, r);
    long double s = share(b * f - c * e, a * e - b * b);
    const long double t = share(b * s + f, e);
    s = share(b * t - c, a);
    look_along(plus(plus(r, s, u), -t, v));
  }

  /// Tries corner k of a side and its projection onto the other triangle's plane, if that is inside the triangle.
  void look_at_face(std::size_t side, std::size_t k) {
    const auto& face = corner_[1 - side];
    const Extended u = plus(face[1], -1, face[0]), v = plus(face[2], -1, face[0]),
                   w = plus(corner_[side][k], -1, face[0]);
    const long double a = dot(u, u), b = dot(u, v), c = dot(v, v), d = dot(w, u), e = dot(w, v);
    const long double det = a * c - b * b, s = d * c - e * b, t = e * a - d * b;
    if (!(det > 0 && s >= 0 && t >= 0 && s + t <= det)) return;
    look_along(plus(plus(w, -s / det, u), -t / det, v));
  }

  std::array<std::array<Extended, 3>, 2> corner_;
  long double size_ = 0, lower_ = 0, upper_ = std::numeric_limits<long double>::infinity();
};

/// The true answer for two sets of triangles.
struct ExactMeshes {
  std::vector<std::uint32_t> pairs;  ///< pairs that meet, flat and sorted
  robustness::Bracket distance{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  double span = 0.0;  ///< largest coordinate difference
};

/// Returns the largest coordinate difference.
inline double span_of(std::span<const Triangle> a, std::span<const Triangle> b) {
  Aabb box;
  for (const auto& side : {a, b})
    for (const Triangle& t : side) box.extend(t.a).extend(t.b).extend(t.c);
  return a.empty() && b.empty() ? 0.0 : (box.upper - box.lower).maxCoeff();
}

/// Returns the true answer for every triangle of a against every triangle of b.
inline ExactMeshes exact_meshes(std::span<const Triangle> a, std::span<const Triangle> b) {
  ExactMeshes exact;
  exact.span = span_of(a, b);
  struct Candidate {
    std::size_t i, j;
    long double lower;
  };
  std::vector<Candidate> apart;
  long double lower = std::numeric_limits<long double>::infinity(), upper = lower;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const ExtendedPair pair(a[i], b[j]);
      if (!(pair.lower() > 0) && OracleDistance(a[i], b[j]).meet()) {
        exact.pairs.push_back(static_cast<std::uint32_t>(i));
        exact.pairs.push_back(static_cast<std::uint32_t>(j));
        continue;
      }
      apart.push_back({i, j, pair.lower()});
      lower = std::min(lower, pair.lower());
      upper = std::min(upper, pair.upper());
    }
  if (!exact.pairs.empty()) {
    exact.distance = {};
    return exact;
  }
  if (apart.empty()) return exact;
  // Bounds that differ by much less than half an ulp of the coordinates suffice; otherwise rationals decide.
  if (lower > 0 && upper - lower <= 0x1p-55L * exact.span) {
    exact.distance = {std::nextafter(static_cast<double>(lower), 0.0),
                      std::nextafter(static_cast<double>(upper), std::numeric_limits<double>::infinity())};
    return exact;
  }
  for (const Candidate& one : apart) {
    if (one.lower > upper) continue;
    const auto distance = bracket_of(OracleDistance(a[one.i], b[one.j]).distance());
    if (distance.high < exact.distance.high) exact.distance = distance;
  }
  return exact;
}

}  // namespace hinge::test
