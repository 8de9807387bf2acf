// SPDX-License-Identifier: BSD-3-Clause
// Minimiser: L-BFGS of NLopt for displacements in angstrom.
#pragma once

#include <nlopt.h>

#include <exception>
#include <functional>
#include <span>
#include <vector>

namespace hinge::molecular {

/// Minimises smooth functions with L-BFGS (Nocedal 1980) of NLopt. One function at a time.
class Minimiser {
 public:
  /// Returns the value at u and, unless `gradient` is empty, writes the derivatives.
  using Objective = std::function<double(std::span<const double> u, std::span<double> gradient)>;

  /// stop must outlive this object. It is called at every evaluation; true ends the descent.
  explicit Minimiser(const std::function<bool()>& stop) : stop_(stop) {}

  /// Moves u (angstrom) to a minimum, until a step moves no value by 1e-4 angstrom, or for this many evaluations.
  /// Throws what the objective or stop() throws.
  void minimise(std::vector<double>& u, const Objective& objective, int evaluations);
  /// True if stop() returned true.
  bool stopped() const noexcept { return stopped_; }

 private:
  /// The callback of NLopt. Exceptions must not pass through C functions.
  static double call(unsigned n, const double* u, double* gradient, void* self) noexcept;

  const std::function<bool()>& stop_;
  const Objective* objective_ = nullptr;  // of the present call of minimise()
  nlopt_opt optimiser_ = nullptr;         // the same
  std::exception_ptr error_;
  bool stopped_ = false;
};

}  // namespace hinge::molecular
