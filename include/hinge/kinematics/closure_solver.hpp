// SPDX-License-Identifier: BSD-3-Clause
// ClosureSolver: moves a configuration onto the set where every closure of a tree holds.
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

struct ClosureOptions {
  /// Closed: no closure's residual is larger (model length unit). Steps converge quadratically, so the next decimals
  /// cost one step at most; positions of a chain 10^4 units long are known to 1e-11.
  double tolerance = 1e-9;
  /// Steps after which a start is given up; what closes at all needs a tenth (docs/explanation/closures.md).
  int most_steps = 200;
};

/// Levenberg and Marquardt's damped least squares on all closures together: each step is the smallest change of the
/// selected DOF that closes the linearised cycles (J. More, "The Levenberg-Marquardt algorithm: implementation and
/// theory", 1978), so the result stays near the start. One per thread. The result is a function of the start alone, the
/// same bits on every CPU.
class ClosureSolver {
 public:
  /// ModelError: a selection made for another tree; numbers out of range.
  ClosureSolver(const KinematicTree& tree, const DofSelection& selection, const ClosureOptions& options = {})
      : ClosureSolver(tree, selection, all_closures(tree), options) {}
  /// Closes some closures of the tree, positions in tree.closures(), and leaves the others as they come.
  ClosureSolver(const KinematicTree& tree, const DofSelection& selection, std::span<const std::size_t> closures,
                const ClosureOptions& options = {})
      : equations_(tree, selection, closures), options_(options) {
    if (!(options.tolerance > 0.0) || !is_length(options.tolerance))
      throw ModelError("closure tolerance " + number_text(options.tolerance) + ": expected a length above 0");
    if (options.most_steps < 0)
      throw ModelError("closure steps " + std::to_string(options.most_steps) + ": expected at least 0");
  }

  /// q: one value per selected DOF (rad or model length unit), changed in place; turns come back in [-pi, pi]. True
  /// when all closures hold within the tolerance; q is then closed, otherwise as near as the solver came.
  /// ConfigurationError: wrong length or a value that is not finite.
  bool close(std::span<double> q);

  /// The worst residual of the last close(), model length unit.
  double residual() const noexcept { return equations_.worst(); }
  int steps() const noexcept { return steps_; }
  /// The residual of one closure after the last close(), model length unit. `k` counts the closures it was made for.
  double residual(std::size_t k) const noexcept { return equations_.residual(k); }
  /// Which values of q it may change: true for a DOF in the cycle of some closure. One entry per selected DOF.
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

/// Turns are limited to this a step (rad): linearised cycles say nothing about turns of a radian.
inline constexpr double largest_closing_turn = 0.6;

inline bool ClosureSolver::close(std::span<double> q) {
  // A start is given up when ten steps in a row have not taken a hundredth off the residual: a minimum that is not
  // closed, which is where starts end that never close.
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

/// The damped step (0 where numbers overflow), by the smaller of the two systems: J^T (J J^T + d I)^-1 r or (J^T J + d
/// I)^-1 J^T r.
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
  // Redundant equations (a hinge is six of which one follows) leave the matrix singular; this much always holds.
  double extra = std::max(damping, 0x1p-40) * largest;
  step_.assign(n, 0.0);
  for (bool factored = false; !factored; extra *= 16.0) {
    if (!(extra > 0.0) || !is_finite(extra)) return;  // no DOF moves any closure, or products overflow
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
