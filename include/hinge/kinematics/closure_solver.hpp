// SPDX-License-Identifier: BSD-3-Clause
// ClosureSolver: changes a configuration so that the closures of a tree hold.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/detail/kinematics/cholesky.hpp"
#include "hinge/kinematics/closure_equations.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/kinematic_tree.hpp"

namespace hinge {

/// Settings of ClosureSolver.
struct ClosureOptions {
  /// Largest accepted residual of a closure (model length unit). Convergence is quadratic, so further decimals cost at
  /// most one step. Positions in a chain of 10^4 units are accurate to 1e-11.
  double tolerance = 1e-9;
  /// Maximum number of steps, >= 0. Solvable starts need about a tenth of it (docs/explanation/closures.md).
  int most_steps = 200;
};

/// Damped least squares of Levenberg and Marquardt on all closures together (J. More, "The Levenberg-Marquardt
/// algorithm: implementation and theory", 1978). Each step is the smallest change of the selected DOF that closes the
/// linearised cycles, so the result stays near the start. The result depends on the start alone and has the same bits
/// on every CPU. Not thread-safe: use one object per thread.
class ClosureSolver {
 public:
  /// Closes all closures. ModelError: a selection for another tree, a tolerance that is not a length above 0, or
  /// negative most_steps.
  ClosureSolver(const KinematicTree& tree, const DofSelection& selection, const ClosureOptions& options = {})
      : ClosureSolver(tree, selection, all_closures(tree), options) {}
  /// Closes the closures with these indices in tree.closures() and ignores the others. held: indices of selected DOF
  /// whose values close() does not change. ModelError: also an unknown index.
  ClosureSolver(const KinematicTree& tree, const DofSelection& selection, std::span<const std::size_t> closures,
                const ClosureOptions& options = {}, std::span<const std::size_t> held = {})
      : equations_(tree, selection, closures, held), options_(options) {
    if (!(options.tolerance > 0.0) || !is_length(options.tolerance))
      throw ModelError("closure tolerance " + number_text(options.tolerance) + ": expected a length above 0");
    if (options.most_steps < 0)
      throw ModelError("closure steps " + std::to_string(options.most_steps) + ": expected at least 0");
  }

  /// Changes q in place. q: one value per selected DOF, rad or model length unit. Angles on cycles are reduced to [-pi,
  /// pi]. Returns true when all closures hold within the tolerance; otherwise q is the best configuration found.
  /// ConfigurationError: wrong length, or a value that is not finite.
  bool close(std::span<double> q);

  /// Returns the largest residual after the last close(), model length unit.
  double residual() const noexcept { return equations_.worst(); }
  /// Returns the number of steps of the last close().
  int steps() const noexcept { return steps_; }
  /// Returns the residual of closure k after the last close(), model length unit. k counts the closures of the
  /// constructor.
  double residual(std::size_t k) const noexcept { return equations_.residual(k); }
  /// Returns one entry per selected DOF: true when it is on the cycle of a closure, so close() may change it.
  std::vector<bool> dofs_in_cycles() const {
    std::vector<bool> in_cycle(equations_.dof_count(), false);
    for (std::size_t column = 0; column < equations_.columns(); ++column) in_cycle[equations_.position(column)] = true;
    return in_cycle;
  }

 private:
  void solve(double damping) noexcept;

  ClosureEquations equations_;
  ClosureOptions options_;
  std::vector<double> trial_, matrix_, factor_, step_, side_;
  int steps_ = 0;
};

/// Largest joint rotation per step (rad). The linearisation is useless for rotations near one radian.
inline constexpr double largest_closing_turn = 0.6;

inline bool ClosureSolver::close(std::span<double> q) {
  // Stop when ten steps in a row reduce the residual by less than 1 percent. The search is then near a local minimum
  // that is not closed.
  constexpr int patience = 10;
  constexpr double progress = 0.99;
  equations_.set(q);
  trial_.assign(q.begin(), q.end());
  double damping = 1e-2, marked = equations_.cost();
  int since_mark = 0;
  for (steps_ = 0; steps_ < options_.most_steps && equations_.worst() > options_.tolerance; ++steps_) {
    const double cost = equations_.cost();
    equations_.compute_jacobian();
    bool better = false;
    for (int attempt = 0; attempt < 12 && !better; ++attempt) {
      solve(damping);
      const double longest = equations_.longest_turn(step_);
      const double scale = longest > largest_closing_turn ? largest_closing_turn / longest : 1.0;
      for (std::size_t k = 0; k < q.size(); ++k) trial_[k] = q[k];
      equations_.add(step_, scale, trial_);
      equations_.set(trial_);
      better = equations_.cost() < cost;
      damping = better ? std::max(damping * 0.2, 1e-12) : damping * 6.0;
    }
    if (!better) {
      equations_.set(q);
      break;
    }
    std::copy(trial_.begin(), trial_.end(), q.begin());
    if (equations_.cost() < progress * progress * marked) {
      marked = equations_.cost();
      since_mark = 0;
    } else if (++since_mark == patience) {
      break;
    }
  }
  equations_.wrap(q);
  equations_.set(q);
  return equations_.worst() <= options_.tolerance;
}

/// Computes the damped step from the smaller of two equivalent systems: J^T (J J^T + d I)^-1 r or (J^T J + d I)^-1 J^T
/// r. The step is 0 when numbers overflow.
inline void ClosureSolver::solve(double damping) noexcept {
  const std::size_t m = equations_.rows(), n = equations_.columns();
  const std::vector<double>&j = equations_.jacobian(), &r = equations_.residuals();
  const bool by_rows = m <= n;
  const std::size_t size = by_rows ? m : n;
  matrix_.assign(size * size, 0.0);
  side_.assign(size, 0.0);
  if (by_rows) {
    for (std::size_t a = 0; a < m; ++a) {
      side_[a] = r[a];
      for (std::size_t b = 0; b <= a; ++b) {
        double sum = 0.0;
        for (std::size_t k = 0; k < n; ++k) sum += j[a * n + k] * j[b * n + k];
        matrix_[a * size + b] = sum;
      }
    }
  } else {
    for (std::size_t row = 0; row < m; ++row)
      for (std::size_t a = 0; a < n; ++a) {
        const double value = j[row * n + a];
        if (value == 0.0) continue;
        side_[a] += value * r[row];
        for (std::size_t b = 0; b <= a; ++b) matrix_[a * size + b] += value * j[row * n + b];
      }
  }
  double largest = 0.0;
  for (std::size_t a = 0; a < size; ++a) largest = std::max(largest, matrix_[a * size + a]);
  // Redundant equations make the matrix singular (of the six equations of a hinge, one depends on the others). This
  // minimum damping keeps it positive definite.
  double extra = std::max(damping, 0x1p-40) * largest;
  step_.assign(n, 0.0);
  for (bool factored = false; !factored; extra *= 16.0) {
    if (!(extra > 0.0) || !is_finite(extra)) return;  // no DOF moves a closure, or products overflow
    factor_ = matrix_;
    for (std::size_t a = 0; a < size; ++a) factor_[a * size + a] += extra;
    factored = detail::factor_cholesky(factor_, size);
  }
  for (std::size_t a = 0; a < size; ++a) {
    for (std::size_t b = 0; b < a; ++b) side_[a] -= factor_[a * size + b] * side_[b];
    side_[a] /= factor_[a * size + a];
  }
  for (std::size_t a = size; a-- > 0;) {
    for (std::size_t b = a + 1; b < size; ++b) side_[a] -= factor_[b * size + a] * side_[b];
    side_[a] /= factor_[a * size + a];
  }
  if (by_rows) {
    for (std::size_t row = 0; row < m; ++row)
      for (std::size_t k = 0; k < n; ++k) step_[k] -= j[row * n + k] * side_[row];
  } else {
    for (std::size_t k = 0; k < n; ++k) step_[k] = -side_[k];
  }
  if (!std::all_of(step_.begin(), step_.end(), [](double x) { return is_finite(x); })) step_.assign(n, 0.0);
}

}  // namespace hinge
