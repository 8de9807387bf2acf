// SPDX-License-Identifier: BSD-3-Clause
// MoveCloser: completes a move so that closed cycles stay closed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "hinge/kinematics/closure_solver.hpp"
#include "hinge/moves/dof_change.hpp"

namespace hinge {

/// Changing a DOF of a cycle opens the cycle. MoveCloser then changes the other DOF of the cycles by the smallest step
/// that closes them (ClosureSolver). Moves of DOF outside all cycles stay unchanged. One per thread.
class MoveCloser {
 public:
  /// closures: positions in tree.closures(); these stay closed. Throws ModelError if the selection was made for another
  /// tree or if a closure does not exist.
  MoveCloser(const KinematicTree& tree, const DofSelection& selection, const std::vector<std::size_t>& closures)
      : solver_(tree, selection, closures), in_cycle_(solver_.dofs_in_cycles()) {}

  /// q: one value per selected DOF, with closed cycles. changes: a move from q, sorted by DOF. It is replaced by a move
  /// to a configuration with closed cycles. Returns false, and leaves `changes` unusable, if the solver fails or ends
  /// at q itself. Throws ConfigurationError if q has a wrong length or a value is not finite (see
  /// ClosureSolver::close).
  bool close(std::span<const double> q, std::vector<DofChange>& changes) {
    if (std::none_of(changes.begin(), changes.end(), [&](const DofChange& change) { return in_cycle_[change.dof]; }))
      return true;
    closed_.assign(q.begin(), q.end());
    for (const DofChange& change : changes) closed_[change.dof] = change.value;
    if (!solver_.close(closed_)) return false;
    changes.clear();
    for (std::size_t k = 0; k < q.size(); ++k)
      if (closed_[k] != q[k]) changes.push_back({k, closed_[k]});
    return !changes.empty();
  }

 private:
  ClosureSolver solver_;
  std::vector<bool> in_cycle_;  // one entry per selected DOF
  std::vector<double> closed_;
};

}  // namespace hinge
