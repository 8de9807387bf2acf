// SPDX-License-Identifier: BSD-3-Clause
// ClashDescent: minimises the steric energy near a start.
#pragma once

#include <nlopt.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "hinge/kinematics/closure_equations.hpp"
#include "hinge/molecular/checker.hpp"

namespace hinge::molecular {

/// The atoms that one value of a configuration moves, at the start.
struct MovedAtoms {
  double lever = 1.0;       ///< root of the moment of inertia (angstrom per rad), or of the number of atoms for slides
  double root_count = 1.0;  ///< root of the number of atoms
  bool in_one_residue = false;  ///< they all belong to one residue
};

/// Minimises Checker::steric(q, softness) + mu * sum of (lever * (q - start))^2 + squared closure residuals, with
/// L-BFGS of NLopt. The second term is the sum of the squared displacements of all atoms, linear in q.
class ClashDescent {
 public:
  static constexpr double softness = 0.02;  ///< angstrom

  /// The checker and stop must outlive this object. stop: called at every evaluation; true ends the descent.
  ClashDescent(Checker& checker, std::span<const double> start, std::span<const std::size_t> closures,
               const std::function<bool()>& stop);

  /// Moves q to the minimum for this mu. Throws what stop() throws.
  void minimise(std::vector<double>& q, double mu);
  /// True if stop() returned true.
  bool stopped() const noexcept { return stopped_; }
  /// One per value.
  const std::vector<MovedAtoms>& moved_atoms() const noexcept { return moved_; }

 private:
  /// The callback of NLopt. Exceptions must not pass through C functions.
  static double call(unsigned n, const double* u, double* gradient, void* self) noexcept;
  /// Returns the objective at displacements u (angstrom, root of a sum over atoms) and its gradient by u.
  double objective(unsigned n, const double* u, double* gradient);
  std::vector<double> at(std::span<const double> u) const;
  void find_moved_atoms();

  Checker& checker_;
  const std::function<bool()>& stop_;
  std::vector<double> start_;
  std::vector<MovedAtoms> moved_;
  std::optional<ClosureEquations> equations_;
  double mu_ = 0.0;
  nlopt_opt optimiser_ = nullptr;  // of the present call of minimise()
  std::exception_ptr error_;       // thrown by stop() or a check
  bool stopped_ = false;
};

}  // namespace hinge::molecular
