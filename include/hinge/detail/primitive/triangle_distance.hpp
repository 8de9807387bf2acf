// SPDX-License-Identifier: BSD-3-Clause
// The distance of two closed triangles in double arithmetic, as lower and upper bounds that include rounding.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/exact/error_free.hpp"
#include "hinge/detail/primitive/triangle_corners.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// Returns a b - c d with a relative error of about two half ulps (Kahan), when nothing underflows.
inline double difference_of_products(double a, double b, double c, double d) noexcept {
  const exact::ValueAndError p = exact::two_product(a, b), q = exact::two_product(c, d);
  return (p.value - q.value) + (p.rest - q.rest);
}

/// Returns the cross product, accurate also for nearly parallel vectors.
inline Vec3 accurate_cross(const Vec3& a, const Vec3& b) noexcept {
  return {difference_of_products(a[1], b[2], a[2], b[1]), difference_of_products(a[2], b[0], a[0], b[2]),
          difference_of_products(a[0], b[1], a[1], b[0])};
}

/// Two triangles in coordinates relative to the first corner of x. R is the largest magnitude of these coordinates. All
/// errors below are relative to R.
class TrianglePair {
 public:
  TrianglePair(const Corners& x, const Corners& y) noexcept : origin_(x[0]) {
    double size = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      x_.corner[k] = x[k] - origin_;
      y_.corner[k] = y[k] - origin_;
      size = std::max({size, largest(x_.corner[k]), largest(y_.corner[k])});
    }
    size_ = size;
    x_.prepare();
    y_.prepare();
  }

  /// Returns true when products of six lengths neither overflow nor lose significant digits to underflow; false for
  /// NaN.
  bool in_window() const noexcept { return size_ >= 0x1p-150 && size_ <= 0x1p150; }

  /// Returns how much rounding may shift a bound of the distance. In half ulps of R: 2 for the relative coordinates;
  /// for the lower bound 5 for the product of a corner with a unit vector, so 14 for two triangles; for the upper bound
  /// 5 for a point of an edge, so 14 for two, and 12 for a point of a face, so 16 with a corner. In half ulps of the
  /// distance: 4 for the root of a sum of squares or the division by the length of the direction.
  double rounding(double distance) const noexcept { return exact::half_ulp * (20 * size_ + 8 * distance); }

  /// Returns true when the normal of one triangle proves that the triangles are at least m apart.
  bool planes_apart(double m) const noexcept { return apart_along(x_.normal, m) || apart_along(y_.normal, m); }

  struct Nearest {
    Vec3 p, q;             ///< points on the triangles, up to rounding; |p - q| is an upper bound of the distance
    double squared = 0.0;  ///< |p - q|^2
    double distance = 0.0;
    double gap = 0.0;  ///< separation along the best known direction: a lower bound of the distance, up to rounding
  };

  Nearest nearest() const noexcept;

  /// Returns true when the two bounds agree. The error of `distance` is then at most 28 u R + 16 u distance (u =
  /// 2^-53).
  bool certain(const Nearest& n) const noexcept {
    return n.distance - n.gap <= exact::half_ulp * (8 * size_ + 8 * n.distance);
  }

  Vec3 placed(const Vec3& local) const noexcept { return local + origin_; }

 private:
  struct Side {
    Corners corner;
    Corners edge;                           // edge k from corner k to corner k + 1
    Vec3 normal, to_first, to_second;       // to_first . (p - corner 0) = n^2 times the parameter of p along edge 0;
                                            // to_second: the same along corner 0 - corner 2
    std::array<double, 3> square, inverse;  // of the edge lengths; inverse is 0 for length 0
    double normal_square = 0.0;

    void prepare() noexcept {
      for (std::size_t k = 0; k < 3; ++k) {
        edge[k] = corner[(k + 1) % 3] - corner[k];
        square[k] = squared_norm(edge[k]);
        inverse[k] = square[k] > 0.0 ? 1.0 / square[k] : 0.0;
      }
      const Vec3 second = corner[2] - corner[0];
      normal = cross(edge[0], second);
      to_first = cross(second, normal);
      to_second = cross(normal, edge[0]);
      normal_square = squared_norm(normal);
    }
  };

  /// Returns the larger of min n.y - max n.x and min n.x - max n.y: the gap along n times |n|.
  double gap_times_norm(const Vec3& n) const noexcept {
    const auto range = [&n](const Corners& c) noexcept {
      const double u = dot(n, c[0]), v = dot(n, c[1]), w = dot(n, c[2]);
      return std::pair(std::min({u, v, w}), std::max({u, v, w}));
    };
    const auto [x_low, x_high] = range(x_.corner);
    const auto [y_low, y_high] = range(y_.corner);
    return std::max(y_low - x_high, x_low - y_high);
  }

  bool apart_along(const Vec3& n, double m) const noexcept {
    const double square = squared_norm(n), gap = gap_times_norm(n);
    if (!(gap > 0.0) || !(square > exact::lost_squares)) return false;
    const double d = gap / std::sqrt(square);
    return d - rounding(d) >= m;
  }

  /// Three vectors in lanes; the fourth lane repeats the first.
  struct Three {
    explicit Three(const std::array<Vec3, 3>& v) noexcept
        : x(simd::Double4::of(v[0][0], v[1][0], v[2][0], v[0][0])),
          y(simd::Double4::of(v[0][1], v[1][1], v[2][1], v[0][1])),
          z(simd::Double4::of(v[0][2], v[1][2], v[2][2], v[0][2])) {}
    simd::Double4 x, y, z;
  };
  static simd::Double4 lanes(const std::array<double, 3>& v) noexcept {
    return simd::Double4::of(v[0], v[1], v[2], v[0]);
  }
  static simd::Double4 dots(const Three& a, const Vec3& b) noexcept {
    return a.x * simd::Double4(b[0]) + a.y * simd::Double4(b[1]) + a.z * simd::Double4(b[2]);
  }

  /// Squared distances of fifteen pairs of features, in rows of four lanes, of which the last repeats the first. Rows 0
  /// to 2: an edge of x and the edges of y. Row 3: corners of x and the face of y. Row 4: corners of y and the face of
  /// x. s and t: parameters of the nearest points of two edges.
  struct Features {
    std::array<double, 20> squares;
    std::array<double, 12> s, t;
  };

  /// Fills row k: edge k of x and each edge of y, given by lanes (Lumelsky 1985, with one more projection at the end).
  /// Degenerate and parallel edges are valid.
  void add_edges(std::size_t k, const Three& corners, const Three& edges, const simd::Double4& square,
                 const simd::Double4& inverse, Features& features) const noexcept {
    using simd::Double4;
    const Double4 zero(0.0), one(1.0);
    const auto clamp = [&](const Double4& share) { return min(max(share, zero), one); };
    const Vec3 &from = x_.corner[k], &u = x_.edge[k];
    const Double4 rx = Double4(from[0]) - corners.x, ry = Double4(from[1]) - corners.y,
                  rz = Double4(from[2]) - corners.z;
    const Double4 a(x_.square[k]), ux(u[0]), uy(u[1]), uz(u[2]);
    const Double4 b = ux * edges.x + uy * edges.y + uz * edges.z, c = ux * rx + uy * ry + uz * rz,
                  f = edges.x * rx + edges.y * ry + edges.z * rz;
    const Double4 determinant = a * square - b * b;
    const Double4 start = clamp(choose_less(zero, determinant, (b * f - c * square) / determinant, zero));
    const Double4 t = clamp((b * start + f) * inverse), s = clamp((b * t - c) * Double4(x_.inverse[k]));
    const Double4 dx = rx + ux * s - edges.x * t, dy = ry + uy * s - edges.y * t, dz = rz + uz * s - edges.z * t;
    (dx * dx + dy * dy + dz * dz).store(features.squares.data() + 4 * k);
    s.store(features.s.data() + 4 * k);
    t.store(features.t.data() + 4 * k);
  }

  /// Writes the squared distances of three points to the face of t, or infinity where the foot of the perpendicular is
  /// outside.
  static void squares_to_face(const Side& t, const Three& points, double* squares) noexcept {
    using simd::Double4;
    const Double4 zero(0.0), infinite(std::numeric_limits<double>::infinity()), square(t.normal_square);
    Three w = points;
    w.x = w.x - Double4(t.corner[0][0]);
    w.y = w.y - Double4(t.corner[0][1]);
    w.z = w.z - Double4(t.corner[0][2]);
    const Double4 s = dots(w, t.to_first), r = dots(w, t.to_second), height = dots(w, t.normal);
    Double4 result = height * height / square;
    result = choose_less(s, zero, infinite, result);
    result = choose_less(r, zero, infinite, result);
    result = choose_less(square, s + r, infinite, result);
    (t.normal_square > exact::lost_squares ? result : infinite).store(squares);
  }

  static Vec3 foot(const Side& t, const Vec3& p) noexcept {
    const Vec3 w = p - t.corner[0];
    const double s = clamped(dot(w, t.to_first) / t.normal_square);
    return on_face(t.corner, s, std::min(clamped(dot(w, t.to_second) / t.normal_square), 1.0 - s));
  }

  Vec3 origin_;
  Side x_, y_;
  double size_ = 0.0;
};

inline TrianglePair::Nearest TrianglePair::nearest() const noexcept {
  Features features;
  const Three corners(y_.corner), edges(y_.edge);
  const simd::Double4 y_square = lanes(y_.square), y_inverse = lanes(y_.inverse);
  for (std::size_t k = 0; k < 3; ++k) add_edges(k, corners, edges, y_square, y_inverse, features);
  squares_to_face(y_, Three(x_.corner), features.squares.data() + 12);
  squares_to_face(x_, corners, features.squares.data() + 16);

  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](std::size_t which) noexcept {
    const double squared = features.squares[which];
    best = squared < least ? which : best;
    least = squared < least ? squared : least;
  };
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t l = 0; l < 3; ++l) offer(4 * k + l);
  for (std::size_t k = 0; k < 3; ++k) {
    offer(12 + k);
    offer(16 + k);
  }

  Nearest n;
  Vec3 direction;
  if (best < 12) {
    const std::size_t k = best / 4, l = best % 4;
    const double s = features.s[best], t = features.t[best];
    n.p = on_edge(x_.corner[k], x_.corner[(k + 1) % 3], s);
    n.q = on_edge(y_.corner[l], y_.corner[(l + 1) % 3], t);
    const bool inside_u = s > 0.0 && s<1.0, inside_v = t> 0.0 && t < 1.0;
    direction = n.p - n.q;
    // The difference of near points has a large relative rounding error. Where a point is interior, use a direction
    // that is perpendicular to its edge instead.
    if (inside_u && inside_v)
      direction = accurate_cross(x_.edge[k], y_.edge[l]);
    else if (inside_u)
      direction -= x_.edge[k] * (dot(direction, x_.edge[k]) * x_.inverse[k]);
    else if (inside_v)
      direction -= y_.edge[l] * (dot(direction, y_.edge[l]) * y_.inverse[l]);
  } else {
    const bool from_x = best < 16;
    const std::size_t k = best % 4;
    const Side& face = from_x ? y_ : x_;
    const Vec3 &corner = (from_x ? x_ : y_).corner[k], on = foot(face, corner);
    n.p = from_x ? corner : on;
    n.q = from_x ? on : corner;
    direction = accurate_cross(face.edge[0], face.edge[1]);
  }
  n.squared = squared_norm(Vec3(n.p - n.q));
  n.distance = std::sqrt(n.squared);
  const double square = squared_norm(direction);
  n.gap = square > exact::lost_squares ? gap_times_norm(direction) / std::sqrt(square) : 0.0;
  return n;
}

}  // namespace hinge::detail
