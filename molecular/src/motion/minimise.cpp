// SPDX-License-Identifier: BSD-3-Clause
// Calls NLopt.
#include "motion/minimise.hpp"

#include <algorithm>
#include <memory>

namespace hinge::molecular {

double Minimiser::call(unsigned n, const double* u, double* gradient, void* self) noexcept {
  auto& minimiser = *static_cast<Minimiser*>(self);
  try {
    minimiser.stopped_ = minimiser.stopped_ || (minimiser.stop_ && minimiser.stop_());
    if (minimiser.stopped_) nlopt_force_stop(minimiser.optimiser_);
    return (*minimiser.objective_)({u, n}, {gradient, gradient == nullptr ? 0U : n});
  } catch (...) {
    if (!minimiser.error_) minimiser.error_ = std::current_exception();
    nlopt_force_stop(minimiser.optimiser_);
    std::fill_n(gradient, gradient == nullptr ? 0U : n, 0.0);  // a minimum: the line search ends, too
    return 0.0;
  }
}

void Minimiser::minimise(std::vector<double>& u, const Objective& objective, int evaluations) {
  constexpr double smallest_move = 1e-4;  // angstrom
  // NLopt stores up to one vector per evaluation if it may, and their products then take longer than the objective.
  constexpr unsigned stored_vectors = 20;
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimiser(
      nlopt_create(NLOPT_LD_LBFGS, static_cast<unsigned>(u.size())), &nlopt_destroy);
  optimiser_ = optimiser.get();
  objective_ = &objective;
  nlopt_set_min_objective(optimiser_, &Minimiser::call, this);
  nlopt_set_xtol_abs1(optimiser_, smallest_move);
  nlopt_set_vector_storage(optimiser_, stored_vectors);
  nlopt_set_maxeval(optimiser_, evaluations);
  double value = 0.0;
  // A negative status says that rounding or stop() ended the descent; u is the best point then, too.
  nlopt_optimize(optimiser_, u.data(), &value);
  if (error_) std::rethrow_exception(error_);
}

}  // namespace hinge::molecular
