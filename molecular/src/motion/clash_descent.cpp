// SPDX-License-Identifier: BSD-3-Clause
// Minimises the steric energy.
#include "motion/clash_descent.hpp"

#include <algorithm>
#include <cmath>

#include "hinge/core/finite.hpp"

namespace hinge::molecular {

namespace {

constexpr double closure_weight = 10.0;  // of squared residuals against squared overlaps
constexpr int most_evaluations = 150;

}  // namespace

double add_closures(ClosureEquations& equations, double weight, std::span<const double> q, std::span<double> gradient) {
  equations.set(q);
  equations.compute_jacobian();
  const std::size_t columns = equations.columns();
  for (std::size_t row = 0; row < equations.rows(); ++row)
    for (std::size_t c = 0; c < columns; ++c)
      gradient[equations.position(c)] +=
          weight * 2.0 * equations.residuals()[row] * equations.jacobian()[row * columns + c];
  return weight * 2.0 * equations.cost();
}

ClashDescent::ClashDescent(Checker& checker, std::span<const double> start, std::span<const std::size_t> closures,
                           const std::function<bool()>& stop)
    : checker_(checker),
      start_(start.begin(), start.end()),
      moved_(find_moved_atoms(checker, start)),
      displacement_(checker, start),
      minimiser_(stop) {
  if (!closures.empty()) equations_.emplace(checker.molecule().model().tree(), checker.selection(), closures);
}

std::vector<double> ClashDescent::at(std::span<const double> u) const {
  std::vector<double> q(start_);
  for (std::size_t k = 0; k < q.size(); ++k) q[k] += u[k] / moved_[k].lever;
  return q;
}

double ClashDescent::objective(std::span<const double> u, std::span<double> gradient, double mu) {
  const std::vector<double> q = at(u);
  if (std::ranges::any_of(q, [](double x) { return !is_length(x); })) return HUGE_VAL;
  Steric steric = checker_.steric(q, softness);
  double value = steric.energy;
  if (mu > 0.0) value += displacement_.add(mu, q, steric.gradient);
  if (equations_) value += add_closures(*equations_, closure_weight, q, steric.gradient);
  for (std::size_t k = 0; k < gradient.size(); ++k) gradient[k] = steric.gradient[k] / moved_[k].lever;
  return value;
}

void ClashDescent::minimise(std::vector<double>& q, double mu) {
  std::vector<double> u(q.size());
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = (q[k] - start_[k]) * moved_[k].lever;
  minimiser_.minimise(
      u, [&](std::span<const double> at, std::span<double> gradient) { return objective(at, gradient, mu); },
      most_evaluations);
  q = at(u);
}

}  // namespace hinge::molecular
