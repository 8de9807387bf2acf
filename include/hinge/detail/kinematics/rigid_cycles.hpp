// SPDX-License-Identifier: BSD-3-Clause
// Finds the selected DOF that closures hold at their reference values, for example the torsions of rigid rings.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "hinge/detail/kinematics/cholesky.hpp"
#include "hinge/kinematics/closure_equations.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/kinematic_tree.hpp"

namespace hinge::detail {

/// Error bounds of the reference geometry.
struct GeometryTolerance {
  double point = 0.0;  ///< position of a joint point or closure point, model length unit
  double axis = 0.0;   ///< direction of a joint axis, rad
};

/// Returns true when the equations of the closures have full column rank in these columns, allowing for `error`: the
/// smallest singular value exceeds the error bound. Test: J^T J minus the squared bound has a Cholesky decomposition.
inline bool has_full_rank(const ClosureEquations& equations, const std::vector<std::size_t>& closures,
                          const std::vector<std::size_t>& columns, const GeometryTolerance& error) {
  const std::size_t n = columns.size();
  std::size_t rows = 0;
  for (const std::size_t c : closures) rows += equations.row_count(c);
  if (n == 0 || n > rows) return false;
  std::vector<double> squared(n * n, 0.0), row(n);  // J^T J, lower triangle
  double squared_bound = 0.0, trace = 0.0;
  for (const std::size_t c : closures) {
    const std::size_t count = equations.row_count(c);
    for (std::size_t r = 0; r < count; ++r) {
      for (std::size_t k = 0; k < n; ++k)
        row[k] = equations.jacobian()[(equations.first_row(c) + r) * equations.columns() + columns[k]];
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; row[a] != 0.0 && b <= a; ++b) squared[a * n + b] += row[a] * row[b];
    }
    for (std::size_t k = 0; k < n; ++k) {
      // A derivative is axis x lever, and both ends of the lever have the error `point`. With lengths, it is projected
      // on a line whose direction also has an error.
      const double lever = equations.lever(c, columns[k]);
      if (lever == 0.0) continue;
      double off = error.axis * lever + 2.0 * error.point;
      if (equations.keeps_lengths(c)) off += lever * 2.0 * error.point / equations.shortest_length(c);
      squared_bound += static_cast<double>(count) * off * off;  // at most `off` per row
    }
  }
  for (std::size_t k = 0; k < n; ++k) trace += squared[k * n + k];
  // Kinematics, products and decomposition together round by less than 2^-40 of the trace, even for 1000 columns.
  const double shift = squared_bound + 0x1p-40 * trace;
  for (std::size_t k = 0; k < n; ++k) squared[k * n + k] -= shift;
  return factor_cholesky(squared, n);
}

/// Returns the DOF of the selection that cannot leave the reference while all closures hold, sorted. A set of DOF is
/// held when the derivatives of some closures with respect to all free DOF on their cycles have full column rank. By
/// the inverse function theorem the reference is then an isolated solution, for every geometry within `error` (Weyl: a
/// singular value changes by at most the Frobenius norm of the error). The search tests each closure alone and each
/// cluster of closures that share DOF, and repeats while it finds held DOF. It never returns a movable DOF, because a
/// mechanism that moves has no full rank; it may miss held DOF. Other assemblies of the same ring are not considered,
/// since motion does not reach them. The result is empty when the reference is not closed within 8 * error.point +
/// 2^-30. kept: the closures that hold, as indices in tree.closures().
inline std::vector<DofId> rigid_cycle_dofs(const KinematicTree& tree, const DofSelection& selection,
                                           const GeometryTolerance& error, std::span<const std::size_t> kept) {
  ClosureEquations equations(tree, selection, kept);
  if (!(equations.worst() <= 8.0 * error.point + 0x1p-30)) return {};
  equations.compute_jacobian();
  std::vector<bool> held(equations.columns(), false);
  const auto free_columns = [&](std::size_t c) {
    std::vector<std::size_t> columns = equations.columns_of(c);
    std::erase_if(columns, [&](std::size_t k) { return held[k]; });
    return columns;
  };
  const auto hold = [&](const std::vector<std::size_t>& closures, const std::vector<std::size_t>& columns) {
    if (!has_full_rank(equations, closures, columns, error)) return false;
    for (const std::size_t k : columns) held[k] = true;
    return true;
  };
  for (bool found = true; found;) {
    found = false;
    std::vector<std::size_t> cluster(equations.closure_count());  // per closure: smallest connected closure
    std::iota(cluster.begin(), cluster.end(), std::size_t{0});
    std::vector<std::size_t> owner(equations.columns(), equations.closure_count());
    for (std::size_t c = 0; c < equations.closure_count(); ++c) {
      const std::vector<std::size_t> columns = free_columns(c);
      if (hold({c}, columns)) {
        found = true;
        continue;
      }
      for (const std::size_t k : columns) {
        if (owner[k] == equations.closure_count()) owner[k] = c;
        const std::size_t from = std::max(cluster[owner[k]], cluster[c]), to = std::min(cluster[owner[k]], cluster[c]);
        std::replace(cluster.begin(), cluster.end(), from, to);
      }
    }
    if (found) continue;
    for (std::size_t first = 0; first < equations.closure_count(); ++first) {
      std::vector<std::size_t> closures, columns;
      for (std::size_t c = first; c < equations.closure_count(); ++c) {
        if (cluster[c] != first) continue;
        closures.push_back(c);
        for (const std::size_t k : free_columns(c)) columns.push_back(k);
      }
      std::sort(columns.begin(), columns.end());
      columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
      if (closures.size() > 1 && hold(closures, columns)) found = true;
    }
  }
  std::vector<DofId> dofs;
  for (std::size_t k = 0; k < held.size(); ++k)
    if (held[k]) dofs.push_back(selection.dofs()[equations.position(k)]);
  std::sort(dofs.begin(), dofs.end());
  return dofs;
}

/// The same for all closures of the tree.
inline std::vector<DofId> rigid_cycle_dofs(const KinematicTree& tree, const DofSelection& selection,
                                           const GeometryTolerance& error = {}) {
  return rigid_cycle_dofs(tree, selection, error, all_closures(tree));
}

}  // namespace hinge::detail
