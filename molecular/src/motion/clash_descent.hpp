// SPDX-License-Identifier: BSD-3-Clause
// ClashDescent: minimises the steric energy near a start.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "hinge/kinematics/closure_equations.hpp"
#include "hinge/molecular/checker.hpp"
#include "motion/displacement.hpp"
#include "motion/minimise.hpp"
#include "motion/moved_atoms.hpp"

namespace hinge::molecular {

/// Files have three decimals, which change a distance by at most sqrt(3) * 0.001 angstrom. Pairs that are farther from
/// a collision than this stay free in them.
inline constexpr double file_rounding = 0.002;  // angstrom

/// Returns weight * (sum of squared residuals) at q and adds its derivatives to `gradient`.
double add_closures(ClosureEquations& equations, double weight, std::span<const double> q, std::span<double> gradient);

/// Minimises Checker::steric(q, softness) + mu * (sum of the squared displacements of all atoms from the start) +
/// squared closure residuals.
class ClashDescent {
 public:
  static constexpr double softness = 0.02;  ///< angstrom

  /// The checker and stop must outlive this object. stop: called at every evaluation; true ends the descent.
  ClashDescent(Checker& checker, std::span<const double> start, std::span<const std::size_t> closures,
               const std::function<bool()>& stop);

  /// Moves q to the minimum for this mu. Throws what stop() throws.
  void minimise(std::vector<double>& q, double mu);
  /// True if stop() returned true.
  bool stopped() const noexcept { return minimiser_.stopped(); }
  /// One per value.
  const std::vector<MovedAtoms>& moved_atoms() const noexcept { return moved_; }

 private:
  /// Returns the objective at displacements u (angstrom, root of a sum over atoms) and its gradient by u.
  double objective(std::span<const double> u, std::span<double> gradient, double mu);
  std::vector<double> at(std::span<const double> u) const;

  Checker& checker_;
  std::vector<double> start_;
  std::vector<MovedAtoms> moved_;
  Displacement displacement_;
  std::optional<ClosureEquations> equations_;
  Minimiser minimiser_;
};

}  // namespace hinge::molecular
