// SPDX-License-Identifier: BSD-3-Clause
// All ways to close a chain that turns about six axes meeting in pairs at three pivots: tripeptide loop closure.
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

/// Turns (rad) to add about before-at and at-behind of the first pivot, of the second, and before-at of the third; the
/// sixth turn, about the last bond, follows.
using PivotTurns = std::array<double, 5>;

/// Every real solution, sorted by the first turn, at most 16: E. Coutsias, C. Seok, M. Jacobson and K. Dill, "A
/// kinematic view of loop closure", J. Comput. Chem. 25, 2004. Lengths of the three sides of the pivots' triangle are
/// fixed, and a turn of each rigid part about its side is left. The angle between the two bonds at each pivot ties two
/// of these turns; two of them eliminated, a trigonometric polynomial of degree 8 in the third is left (16 in the
/// tangent of half of it). Its roots are isolated by bounds on its derivatives and finished by Newton's method on the
/// three equations. None when the sides make no triangle, or the pivots lie on a line. Two solutions nearer than about
/// 1e-4 rad may come as one.
inline std::vector<PivotTurns> solve_tripeptide_closure(const OpenChain& chain);

/// A trigonometric polynomial of degree 8, sum of c[k] cos kt + s[k] sin kt, and where it may be zero.
class TrigonometricRoots {
 public:
  static constexpr std::size_t degree = 8;

  /// From its values at 32 equal steps of a turn; more than the 17 it takes, so that rounding averages out.
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

  /// Roots, each isolated by its neighbourhood's derivatives, and middles of intervals of 1e-7 rad in which a double
  /// root could not be ruled out.
  std::vector<double> find() {
    constexpr std::size_t pieces = 32;
    constexpr double half = std::numbers::pi / pieces;
    for (std::size_t n = 0; n < pieces; ++n)
      search(-std::numbers::pi + (2.0 * static_cast<double>(n) + 1.0) * half, half);
    return std::move(roots_);
  }

 private:
  /// Value and first two derivatives.
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
    // Where values are below what the samples' rounding may add up to, Newton's method decides, from a few places.
    const double noise = 1e-11 * bound_[0];
    const bool flat = std::abs(f[0]) + std::abs(f[1]) * half + 0.5 * bound_[2] * half * half < noise;
    if (half < (flat ? 5e-3 : std::abs(f[0]) < noise ? 1e-4 : 1e-7)) {
      roots_.push_back(middle);
      return;
    }
    search(middle - half / 2, half / 2);
    search(middle + half / 2, half / 2);
  }

  /// At most one root, as the polynomial is monotone here. Newton's method on the eliminated equations goes on from it.
  void bisect(double low, double high) {
    const double below = at(low)[0];
    if ((below > 0.0) == (at(high)[0] > 0.0)) {
      // Rounding may hide a root at the border; what is none is sorted out later.
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
  std::array<double, 4> bound_{};  // of the absolute value of the polynomial and its first three derivatives
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
      // A start that runs away belongs to another root, or to none.
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
