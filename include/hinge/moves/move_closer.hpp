// SPDX-License-Identifier: BSD-3-Clause
// MoveCloser: completes moves so that closed cycles stay closed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "hinge/kinematics/closure_solver.hpp"
#include "hinge/moves/dof_change.hpp"

namespace hinge {

/// A move of a DOF in a cycle opens it; the other DOF of the cycles then follow by the smallest turns that close them
/// (ClosureSolver). Moves of DOF outside of all cycles are left as they are. One per thread.
class MoveCloser {
 public:
  /// Keeps `closures`, positions in tree.closures(). ModelError: a selection made for another tree, no such closure.
  MoveCloser(const KinematicTree& tree, const DofSelection& selection, const std::vector<std::size_t>& closures)
      : solver_(tree, selection, closures), in_cycle_(solver_.dofs_in_cycles()) {}

  /// q: a configuration with closed cycles. changes: a move from it, sorted by DOF; replaced by one that leads to
  /// closed cycles again. False, with the changes of no use, when the solver finds none.
  bool close(std::span<const double> q, std::vector<DofChange>& changes) {
    if (std::ranges::none_of(changes, [&](const DofChange& change) { return in_cycle_[change.dof]; })) return true;
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
  std::vector<bool> in_cycle_;  // by position in a configuration
  std::vector<double> closed_;
};

}  // namespace hinge
