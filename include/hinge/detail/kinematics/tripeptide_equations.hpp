// SPDX-License-Identifier: BSD-3-Clause
// PivotEquations: the three bond angles that couple the rigid segments between three pivots, and their eliminant.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/core/sincos.hpp"

namespace hinge::detail {

/// An atom of the chain with a rotatable bond on each side, for example the N, C-alpha and C of a residue.
struct Pivot {
  Vec3 before, at, behind;
};

/// The chain in its current state, open or closed. The segments between two pivots are rigid: other torsions keep their
/// values. `before` and `at` of the first pivot are fixed. The closed chain has `at` of the last pivot at end_at and
/// its `behind` at end_behind.
struct OpenChain {
  std::array<Pivot, 3> pivots;
  Vec3 end_at, end_behind;
};

/// Returns the angle (rad, in [-pi, pi]) with cosine c and sine s, up to a common positive factor. It has the same bits
/// on every CPU: Newton steps with our sine and cosine, from a rational start with an error of at most 0.07.
inline double turn_of(double c, double s) noexcept {
  const double length = std::sqrt(c * c + s * s);
  if (!(length > 0.0)) return 0.0;
  c /= length;
  s /= length;
  const double t = s / (1.0 + std::abs(c));  // tangent of half the angle to the nearer half of the x axis
  double angle = 2.0 * t * (std::numbers::pi / 4.0 + 0.273 * (1.0 - std::abs(t)));
  if (c < 0.0) angle = (s < 0.0 ? -std::numbers::pi : std::numbers::pi) - angle;
  for (int k = 0; k < 4; ++k) {
    const SinCos now = sincos(angle);
    angle += s * now.cos - c * now.sin;
  }
  return angle;
}

inline double dihedral_turn(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  const Vec3 v = c - b;
  const Vec3 m = cross(Vec3(b - a), v), n = cross(v, Vec3(d - c));
  return turn_of(dot(m, n), norm(v) * dot(Vec3(b - a), n));
}

/// A direction that rotates about a side: c + a cos t + b sin t.
struct TurningDirection {
  Vec3 c, a, b;
  Vec3 at(const SinCos& t) const noexcept { return c + a * t.cos + b * t.sin; }
  Vec3 slope(const SinCos& t) const noexcept { return b * t.cos - a * t.sin; }
};

/// Describes the rotation of a segment's direction about a side of the triangle. side: in the current chain.
/// side_there: in the frame of the triangle, in the plane z = 0. All directions of one segment have the same zero
/// angle.
inline TurningDirection turning(const Vec3& direction, const Vec3& side, const Vec3& side_there) noexcept {
  const Vec3 x = side / norm(side), u = direction / norm(direction);
  Eigen::Index least = 0;  // the coordinate axis that is most perpendicular to the side
  for (Eigen::Index k = 1; k < 3; ++k)
    if (std::abs(x[k]) < std::abs(x[least])) least = k;
  const Vec3 unit = Vec3::Unit(least), off = unit - x * x[least];
  const Vec3 y = off / norm(off), z = cross(x, y);
  const Vec3 along = side_there / norm(side_there), towards(-along[1], along[0], 0.0), across = cross(along, towards);
  const double p = dot(u, x), q = dot(u, y), r = dot(u, z);
  return {along * p, towards * q + across * r, across * q - towards * r};
}

/// The three bond angle equations, and the eliminant in one rotation.
class PivotEquations {
 public:
  /// Frame of the triangle: first pivot at the origin, third on the x axis, second in the plane z = 0 with y > 0.
  explicit PivotEquations(const OpenChain& chain) {
    const auto& p = chain.pivots;
    const Vec3 first = p[1].at - p[0].at, second = p[2].at - p[1].at, base = chain.end_at - p[0].at;
    const double d1 = norm(first), d2 = norm(second), d0 = norm(base);
    const double x = (d0 * d0 + d1 * d1 - d2 * d2) / (2.0 * d0), squared_y = d1 * d1 - x * x;
    // The comparisons are false for NaN, which sides of length 0 produce; the equations are then not solvable.
    if (!(squared_y > 1e-12 * d1 * d1) || !(d2 > 0.0)) return;
    at_ = {Vec3::Zero(), Vec3(x, std::sqrt(squared_y), 0.0), Vec3(d0, 0.0, 0.0)};
    const std::array<Vec3, 3> now{base, first, second};
    const std::array<Vec3, 3> then{at_[2], at_[1], at_[2] - at_[1]};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& behind = k == 2 ? chain.end_behind : p[k].behind;
      const Vec3 to_behind = behind - (k == 2 ? chain.end_at : p[k].at), to_before = p[k].before - p[k].at;
      const Vec3 in_chain = p[k].behind - p[k].at;
      // `before` belongs to the segment in front of the pivot and `behind` to the next segment (0: base, 1, 2).
      before_[k] = turning(to_before, now[k], then[k]);
      behind_[k] = turning(to_behind, now[(k + 1) % 3], then[(k + 1) % 3]);
      cosine_[k] = dot(to_before, in_chain) / (norm(to_before) * norm(in_chain));
      length_[2 * k] = norm(to_before);
      length_[2 * k + 1] = norm(to_behind);
    }
    solvable_ = true;
  }

  bool solvable() const noexcept { return solvable_; }

  /// Returns the residuals of the three equations. t: rotations of the base and of the two segments.
  std::array<double, 3> values(const std::array<SinCos, 3>& t) const noexcept {
    std::array<double, 3> g;
    for (std::size_t k = 0; k < 3; ++k) g[k] = dot(before_[k].at(t[k]), behind_[k].at(t[(k + 1) % 3])) - cosine_[k];
    return g;
  }

  /// Returns the eliminant at a rotation of the base: the second equation multiplied over both solutions of the first
  /// and both of the third equation, complex ones included, times a weight that makes it a polynomial.
  double eliminant(const SinCos& t) const noexcept {
    using Complex = std::complex<double>;
    const Roots one = roots(behind_[0], before_[0].at(t), cosine_[0]),
                two = roots(before_[2], behind_[2].at(t), cosine_[2]);
    Complex product = one.weight * one.weight * two.weight * two.weight;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) {
        Complex sum = -cosine_[1];
        for (Eigen::Index x = 0; x < 3; ++x)
          sum += (before_[1].c[x] + before_[1].a[x] * one.cosine[i] + before_[1].b[x] * one.sine[i]) *
                 (behind_[1].c[x] + behind_[1].a[x] * two.cosine[j] + behind_[1].b[x] * two.sine[j]);
        product *= sum;
      }
    return product.real();
  }

  /// Returns start values for refine() at rotation t (rad) of the base. Imaginary parts are dropped.
  std::vector<std::array<double, 3>> starts(double t) const {
    const SinCos sc = sincos(t);
    const Roots one = roots(behind_[0], before_[0].at(sc), cosine_[0]),
                two = roots(before_[2], behind_[2].at(sc), cosine_[2]);
    std::vector<std::array<double, 3>> all;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j)
        all.push_back(
            {t, turn_of(one.cosine[i].real(), one.sine[i].real()), turn_of(two.cosine[j].real(), two.sine[j].real())});
    return all;
  }

  /// Newton's method on t (rad). Returns false when it does not converge.
  bool refine(std::array<double, 3>& t) const noexcept {
    constexpr double solved = 1e-13;  // residual of a cosine
    for (int step = 0; step < 40; ++step) {
      const std::array<SinCos, 3> sc{sincos(t[0]), sincos(t[1]), sincos(t[2])};
      const std::array<double, 3> g = values(sc);
      if (std::max({std::abs(g[0]), std::abs(g[1]), std::abs(g[2])}) <= solved) return true;
      std::array<double, 3> own, next;  // d g[k] / d t[k], d t[k + 1]
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t after = (k + 1) % 3;
        own[k] = dot(before_[k].slope(sc[k]), behind_[k].at(sc[after]));
        next[k] = dot(before_[k].at(sc[k]), behind_[k].slope(sc[after]));
      }
      const double determinant = own[0] * own[1] * own[2] + next[0] * next[1] * next[2];
      if (!(std::abs(determinant) > 1e-30)) return false;
      const std::array<double, 3> change{
          (g[0] * own[1] * own[2] - next[0] * (g[1] * own[2] - next[1] * g[2])) / determinant,
          (g[1] * own[2] * own[0] - next[1] * (g[2] * own[0] - next[2] * g[0])) / determinant,
          (g[2] * own[0] * own[1] - next[2] * (g[0] * own[1] - next[0] * g[1])) / determinant};
      for (std::size_t k = 0; k < 3; ++k) t[k] -= std::clamp(change[k], -0.3, 0.3);
    }
    return false;
  }

  /// Returns the chain of a solution, in the frame of the triangle.
  OpenChain placed(const std::array<double, 3>& t) const noexcept {
    OpenChain chain;
    const std::array<SinCos, 3> sc{sincos(t[0]), sincos(t[1]), sincos(t[2])};
    for (std::size_t k = 0; k < 3; ++k)
      chain.pivots[k] = {at_[k] + before_[k].at(sc[k]) * length_[2 * k], at_[k],
                         at_[k] + behind_[k].at(sc[(k + 1) % 3]) * length_[2 * k + 1]};
    chain.end_at = chain.pivots[2].at;
    chain.end_behind = chain.pivots[2].behind;
    return chain;
  }

 private:
  struct Roots {
    std::array<std::complex<double>, 2> cosine, sine;
    double weight;
  };

  /// Solves for the rotations at which the direction has this cosine with `other`.
  static Roots roots(const TurningDirection& direction, const Vec3& other, double cosine) noexcept {
    const double a = dot(other, direction.a), b = dot(other, direction.b), c = cosine - dot(other, direction.c);
    Roots r;
    r.weight = std::max(a * a + b * b, 1e-300);
    const double d = r.weight - c * c;
    const std::complex<double> root =
        d >= 0.0 ? std::complex<double>(std::sqrt(d), 0.0) : std::complex<double>(0.0, std::sqrt(-d));
    r.cosine = {(a * c - b * root) / r.weight, (a * c + b * root) / r.weight};
    r.sine = {(b * c + a * root) / r.weight, (b * c - a * root) / r.weight};
    return r;
  }

  std::array<Vec3, 3> at_{};
  std::array<TurningDirection, 3> before_{}, behind_{};
  std::array<double, 3> cosine_{};
  std::array<double, 6> length_{};
  bool solvable_ = false;
};

}  // namespace hinge::detail
