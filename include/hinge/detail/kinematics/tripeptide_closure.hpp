// SPDX-License-Identifier: BSD-3-Clause
// Tripeptide loop closure: all solutions for a chain that rotates about six axes, which meet in pairs at three pivots.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "hinge/detail/core/sincos.hpp"
#include "hinge/detail/kinematics/tripeptide_equations.hpp"

namespace hinge::detail {

/// Angles (rad) to add about the bonds before-at and at-behind of the first pivot, the same of the second pivot, and
/// before-at of the third pivot. The sixth angle, about the last bond, follows from them.
using PivotTurns = std::array<double, 5>;

/// Returns every real solution, at most 16, sorted by the first angle (E. Coutsias, C. Seok, M. Jacobson and K. Dill,
/// "A kinematic view of loop closure", J. Comput. Chem. 25, 2004). The three pivots form a triangle with fixed side
/// lengths. Each rigid segment can rotate about its side. The bond angle at each pivot relates two of these three
/// rotations. Elimination of two rotations leaves a trigonometric polynomial of degree 8 in the third (degree 16 in the
/// tangent of the half angle). Its roots are isolated by bounds on its derivatives and refined by Newton's method on
/// the three equations. There is no solution when the sides do not form a triangle or the pivots are collinear. Two
/// solutions closer than about 1e-4 rad may be merged.
inline std::vector<PivotTurns> solve_tripeptide_closure(const OpenChain& chain);

/// A trigonometric polynomial of degree 8, sum of c[k] cos kt + s[k] sin kt, and a search for its zeros.
class TrigonometricRoots {
 public:
  static constexpr std::size_t degree = 8;

  /// Interpolates the function at 32 equal steps of a full turn. 17 samples would suffice; more of them average out
  /// rounding.
  template <class F>
  explicit TrigonometricRoots(const F& value) {
    constexpr std::size_t samples = 32;
    for (std::size_t n = 0; n < samples; ++n) {
      const double v = value(sincos(2.0 * std::numbers::pi * static_cast<double>(n) / samples));
      for (std::size_t k = 0; k <= degree; ++k) {
        const SinCos sc = sincos(2.0 * std::numbers::pi * static_cast<double>(n * k % samples) / samples);
        cosine_[k] += v * sc.cos * (k == 0 ? 1.0 : 2.0) / samples;
        sine_[k] += v * sc.sin * 2.0 / samples;
      }
    }
    for (std::size_t k = 0; k <= degree; ++k) {
      double bound = std::abs(cosine_[k]) + std::abs(sine_[k]);
      for (double& b : bound_) {
        b += bound;
        bound *= static_cast<double>(k);
      }
    }
  }

  /// Returns the roots (rad). A root is isolated by derivative bounds, or is the midpoint of a small interval that may
  /// contain a double root: half width below 1e-7 rad, or up to 5e-3 rad where values are below the rounding error.
  std::vector<double> find() {
    constexpr std::size_t pieces = 32;
    constexpr double half = std::numbers::pi / pieces;
    for (std::size_t n = 0; n < pieces; ++n)
      search(-std::numbers::pi + (2.0 * static_cast<double>(n) + 1.0) * half, half);
    return std::move(roots_);
  }

 private:
  /// Returns the value and the first two derivatives at t.
  std::array<double, 3> at(double t) const noexcept {
    const SinCos one = sincos(t);
    std::array<double, 3> f{cosine_[0], 0.0, 0.0};
    double c = 1.0, s = 0.0;
    for (std::size_t k = 1; k <= degree; ++k) {
      const double next = c * one.cos - s * one.sin;
      s = s * one.cos + c * one.sin;
      c = next;
      const double n = static_cast<double>(k), even = cosine_[k] * c + sine_[k] * s;
      f[0] += even;
      f[1] += n * (sine_[k] * c - cosine_[k] * s);
      f[2] -= n * n * even;
    }
    return f;
  }

  void search(double middle, double half) {
    const std::array<double, 3> f = at(middle);
    const double rounding = 1e-14 * bound_[0];
    if (std::abs(f[0]) > std::abs(f[1]) * half + 0.5 * bound_[2] * half * half + rounding) return;
    if (std::abs(f[1]) > std::abs(f[2]) * half + 0.5 * bound_[3] * half * half) {
      bisect(middle - half, middle + half);
      return;
    }
    // Here the values are below the accumulated rounding of the samples. Stop early; Newton's method decides later.
    const double noise = 1e-11 * bound_[0];
    const bool flat = std::abs(f[0]) + std::abs(f[1]) * half + 0.5 * bound_[2] * half * half < noise;
    if (half < (flat ? 5e-3 : std::abs(f[0]) < noise ? 1e-4 : 1e-7)) {
      roots_.push_back(middle);
      return;
    }
    search(middle - half / 2, half / 2);
    search(middle + half / 2, half / 2);
  }

  /// Finds the only possible root of an interval on which the polynomial is monotone. Newton's method on the original
  /// equations refines it later.
  void bisect(double low, double high) {
    const double below = at(low)[0];
    if ((below > 0.0) == (at(high)[0] > 0.0)) {
      // Rounding may hide a root at an end of the interval. False roots are discarded later.
      const double border = 1e-12 * bound_[0];
      if (std::abs(below) < border) roots_.push_back(low);
      if (std::abs(at(high)[0]) < border) roots_.push_back(high);
      return;
    }
    for (int k = 0; k < 45; ++k) {
      const double middle = 0.5 * (low + high);
      ((at(middle)[0] > 0.0) == (below > 0.0) ? low : high) = middle;
    }
    roots_.push_back(0.5 * (low + high));
  }

  std::array<double, degree + 1> cosine_{}, sine_{};
  std::array<double, 4> bound_{};  // bounds of the absolute value of the polynomial and its first three derivatives
  std::vector<double> roots_;
};

inline std::array<double, 5> dihedrals(const OpenChain& chain) noexcept {
  const auto& p = chain.pivots;
  return {dihedral_turn(chain.end_at, p[0].before, p[0].at, p[0].behind),
          dihedral_turn(p[0].before, p[0].at, p[0].behind, p[1].at),
          dihedral_turn(p[0].at, p[1].before, p[1].at, p[1].behind),
          dihedral_turn(p[1].before, p[1].at, p[1].behind, p[2].at),
          dihedral_turn(p[1].at, p[2].before, p[2].at, p[2].behind)};
}

inline std::vector<PivotTurns> solve_tripeptide_closure(const OpenChain& chain) {
  const PivotEquations equations(chain);
  std::vector<PivotTurns> solutions;
  if (!equations.solvable()) return solutions;
  constexpr double turn = 2.0 * std::numbers::pi;
  const auto wrapped = [](double angle) { return angle - turn * std::nearbyint(angle / turn); };
  const std::array<double, 5> now = dihedrals(chain);
  TrigonometricRoots eliminant([&](const SinCos& t) { return equations.eliminant(t); });
  for (const double root : eliminant.find())
    for (std::array<double, 3>& t : equations.starts(root)) {
      // A start that moves far away converged to another root, or to none.
      constexpr double near = 1e-2;
      if (!equations.refine(t) || std::abs(t[0] - root) > near) continue;
      PivotTurns turns = dihedrals(equations.placed(t));
      for (std::size_t k = 0; k < turns.size(); ++k) turns[k] = wrapped(turns[k] - now[k]);
      const bool known = std::any_of(solutions.begin(), solutions.end(), [&](const PivotTurns& other) {
        double apart = 0.0;
        for (std::size_t k = 0; k < turns.size(); ++k) apart = std::max(apart, std::abs(wrapped(turns[k] - other[k])));
        return apart < 1e-7;
      });
      if (!known) solutions.push_back(turns);
    }
  std::sort(solutions.begin(), solutions.end());
  return solutions;
}

}  // namespace hinge::detail
