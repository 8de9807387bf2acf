// SPDX-License-Identifier: BSD-3-Clause
// ClosureEquations: the closure residuals of a tree as functions of the selected DOF, with their derivatives.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/kinematics/kinematic_tree.hpp"
#include "hinge/kinematics/rigid_groups.hpp"

namespace hinge {

/// Returns the indices of all closures of a tree.
inline std::vector<std::size_t> all_closures(const KinematicTree& tree) {
  std::vector<std::size_t> closures(tree.closures().size());
  std::iota(closures.begin(), closures.end(), std::size_t{0});
  return closures;
}

/// Residuals and Jacobian of some closures. A closure gives six rows (two points, first link minus second link) or,
/// with lengths, three. A column is a selected DOF on the cycle of a closure: on the path between its two links, and
/// not held. Forward kinematics uses the order of operations of Pose and computes only the groups that closures need.
/// Not thread-safe.
class ClosureEquations {
 public:
  /// Equations of all closures of the tree at the reference. ModelError: a selection for another tree.
  ClosureEquations(const KinematicTree& tree, const DofSelection& selection)
      : ClosureEquations(tree, selection, all_closures(tree)) {}
  /// Equations of the closures with these indices in tree.closures(), renumbered 0, 1, ... in the given order. held:
  /// indices of selected DOF that are no columns. ModelError: also an index that does not exist.
  ClosureEquations(const KinematicTree& tree, const DofSelection& selection, std::span<const std::size_t> closures,
                   std::span<const std::size_t> held = {});

  /// Evaluates the residuals at q, one value per selected DOF. ConfigurationError: wrong length, or a value that is not
  /// finite.
  void set(std::span<const double> q);
  /// Computes jacobian() at the q of the last set().
  void compute_jacobian() noexcept;

  /// Returns the number of equations.
  std::size_t rows() const noexcept { return residuals_.size(); }
  /// Returns the number of columns.
  std::size_t columns() const noexcept { return column_dof_.size(); }
  /// Returns the number of selected DOF: the length of q.
  std::size_t dof_count() const noexcept { return dof_count_; }
  /// Returns the index in q of a column's DOF.
  std::size_t position(std::size_t column) const noexcept { return column_dof_[column]; }
  /// Returns the residuals, rows() values, model length unit.
  const std::vector<double>& residuals() const noexcept { return residuals_; }
  /// Returns d(row)/d(column) at [row * columns() + column], per rad or per model length unit.
  const std::vector<double>& jacobian() const noexcept { return jacobian_; }
  /// Returns half the sum of squared residuals.
  double cost() const noexcept { return cost_; }
  /// Returns the largest closure_residual() of all closures, model length unit.
  double worst() const noexcept { return worst_; }

  /// Returns the number of closures.
  std::size_t closure_count() const noexcept { return cycles_.size(); }
  /// Returns the closure_residual() of one closure, model length unit.
  double residual(std::size_t closure) const noexcept {
    const Cycle& cycle = cycles_[closure];
    return closure_residual(cycle.closure, poses_[cycle.first], poses_[cycle.second]);
  }
  /// Returns the first row of a closure.
  std::size_t first_row(std::size_t closure) const noexcept { return cycles_[closure].first_row; }
  /// Returns the number of rows of a closure.
  std::size_t row_count(std::size_t closure) const noexcept { return keeps_lengths(closure) ? 3 : 6; }
  /// Returns true when the closure fixes lengths instead of points.
  bool keeps_lengths(std::size_t closure) const noexcept { return cycles_[closure].closure.lengths.has_value(); }
  /// Returns the columns on the cycle of a closure, sorted.
  std::vector<std::size_t> columns_of(std::size_t closure) const;
  /// Returns the largest distance between a point of the closure and the axis point of the column's joint, model length
  /// unit; 0 when the column is not on the cycle.
  double lever(std::size_t closure, std::size_t column) const noexcept;

  /// Returns the smallest fixed length of a closure with lengths, model length unit.
  double shortest_length(std::size_t closure) const noexcept {
    const auto& lengths = *cycles_[closure].closure.lengths;
    return *std::min_element(lengths.begin(), lengths.end());
  }

  /// Returns the largest magnitude of a revolute joint's change in a step (columns() values), rad.
  double longest_turn(std::span<const double> step) const noexcept;
  /// q += scale * step. step: columns() values; q: dof_count() values.
  void add(std::span<const double> step, double scale, std::span<double> q) const noexcept;
  /// Reduces the angles of the revolute columns to [-pi, pi]. q: dof_count() values.
  void wrap(std::span<double> q) const noexcept;

 private:
  struct Mover {  // a joint on the cycle; moves_first: on the side of the first link
    std::size_t column, group;
    bool moves_first;
  };
  struct Cycle {
    Closure closure;  // points in the frames of their rigid groups
    std::size_t first, second, first_row;
    std::vector<Mover> movers{};
  };
  struct Axis {
    Vec3 direction, point;  // world frame
  };

  static Vec3 derivative(bool turns, const Axis& axis, const Vec3& at) noexcept {
    return turns ? cross(axis.direction, Vec3(at - axis.point)) : axis.direction;
  }
  std::array<Vec3, 2> points(const Cycle& cycle, bool first) const noexcept {
    const auto& local = first ? cycle.closure.in_first : cycle.closure.in_second;
    const Pose& pose = poses_[first ? cycle.first : cycle.second];
    return {pose * local[0], pose * local[1]};
  }

  RigidGroups groups_;
  std::size_t dof_count_;
  std::vector<Cycle> cycles_;
  std::vector<std::size_t> needed_;  // groups on the path from a closure to the world, parents first
  std::vector<Pose> poses_;          // per group; only needed_ is computed
  std::vector<Axis> axes_;           // per group
  std::vector<std::size_t> column_dof_, column_group_;
  std::vector<double> residuals_, jacobian_;
  double cost_ = 0.0, worst_ = 0.0;
};

inline ClosureEquations::ClosureEquations(const KinematicTree& tree, const DofSelection& selection,
                                          std::span<const std::size_t> closures, std::span<const std::size_t> held)
    : groups_(tree, selection), dof_count_(selection.size()), poses_(groups_.size()), axes_(groups_.size()) {
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<bool> needed(groups_.size(), false), is_held(dof_count_, false);
  for (const std::size_t k : held) {
    if (k >= dof_count_)
      throw ModelError("held DOF " + std::to_string(k) + ": expected below " + std::to_string(dof_count_) +
                       ", the number of selected DOF");
    is_held[k] = true;
  }
  std::vector<std::size_t> column_of(groups_.size(), none);
  const auto parent = [&](std::size_t g) { return index(groups_[id<GroupId>(g)].parent); };
  std::size_t row = 0;
  for (const std::size_t c : closures) {
    if (c >= tree.closures().size())
      throw ModelError("closure " + std::to_string(c) + ": expected below " + std::to_string(tree.closures().size()) +
                       ", the number of closures");
    const Closure& closure = tree.closures()[c];
    Cycle cycle{closure, index(groups_.group_of(closure.first)), index(groups_.group_of(closure.second)), row};
    row += closure.lengths ? 3 : 6;
    for (std::size_t k = 0; k < 2; ++k) {
      cycle.closure.in_first[k] = groups_.link_in_group(closure.first) * closure.in_first[k];
      cycle.closure.in_second[k] = groups_.link_in_group(closure.second) * closure.in_second[k];
    }
    std::size_t a = cycle.first, b = cycle.second;
    while (a != b) {
      const bool first = a > b;  // parents have smaller indices
      std::size_t& g = first ? a : b;
      const std::size_t dof = groups_[id<GroupId>(g)].dof;
      if (!is_held[dof]) {
        if (column_of[g] == none) {
          column_of[g] = column_dof_.size();
          column_dof_.push_back(dof);
          column_group_.push_back(g);
        }
        cycle.movers.push_back({column_of[g], g, first});
      }
      g = parent(g);
    }
    for (std::size_t g : {cycle.first, cycle.second})
      for (; g != 0 && !needed[g]; g = parent(g)) needed[g] = true;
    cycles_.push_back(std::move(cycle));
  }
  for (std::size_t g = 1; g < groups_.size(); ++g)
    if (needed[g]) needed_.push_back(g);
  residuals_.resize(row);
  jacobian_.resize(row * columns());
  set(std::vector<double>(dof_count_, 0.0));
}

inline void ClosureEquations::set(std::span<const double> q) {
  if (q.size() != dof_count_)
    throw ConfigurationError("configuration has " + std::to_string(q.size()) + " values, expected " +
                             std::to_string(dof_count_));
  for (std::size_t k = 0; k < q.size(); ++k)
    if (!is_finite(q[k]))
      throw ConfigurationError("configuration value " + std::to_string(k) + " is " + number_text(q[k]) +
                               ", expected a finite number");
  for (const std::size_t g : needed_) {
    const RigidGroup& group = groups_[id<GroupId>(g)];
    const Pose before = poses_[index(group.parent)] * group.joint.origin;
    axes_[g] = {product(before.rotation, group.joint.axis), before * group.joint.point};
    poses_[g] = before * motion(group.joint, q[group.dof]);
  }
  cost_ = worst_ = 0.0;
  for (const Cycle& cycle : cycles_) {
    const auto a = points(cycle, true), b = points(cycle, false);
    double* r = residuals_.data() + cycle.first_row;
    if (cycle.closure.lengths) {
      for (std::size_t k = 0; k < 3; ++k)
        r[k] = norm(Vec3(a[kept_lengths[k][0]] - b[kept_lengths[k][1]])) - (*cycle.closure.lengths)[k];
    } else {
      for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t x = 0; x < 3; ++x)
          r[3 * k + x] = a[k][static_cast<Eigen::Index>(x)] - b[k][static_cast<Eigen::Index>(x)];
    }
    worst_ = std::max(worst_, closure_residual(cycle.closure, poses_[cycle.first], poses_[cycle.second]));
  }
  for (const double r : residuals_) cost_ += 0.5 * r * r;
}

inline void ClosureEquations::compute_jacobian() noexcept {
  const std::size_t n = columns();
  std::fill(jacobian_.begin(), jacobian_.end(), 0.0);
  for (const Cycle& cycle : cycles_) {
    const auto a = points(cycle, true), b = points(cycle, false);
    for (const Mover& mover : cycle.movers) {
      const bool turns = groups_[id<GroupId>(mover.group)].joint.kind == JointKind::revolute;
      const Axis& axis = axes_[mover.group];
      const double sign = mover.moves_first ? 1.0 : -1.0;
      double* column = jacobian_.data() + cycle.first_row * n + mover.column;
      if (cycle.closure.lengths) {
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3 &p = a[kept_lengths[k][0]], &s = b[kept_lengths[k][1]];
          const Vec3 apart = p - s;
          const double length = norm(apart);
          if (length > 0.0)
            column[k * n] = sign * dot(apart, derivative(turns, axis, mover.moves_first ? p : s)) / length;
        }
      } else {
        for (std::size_t k = 0; k < 2; ++k) {
          const Vec3 d = derivative(turns, axis, mover.moves_first ? a[k] : b[k]);
          for (std::size_t x = 0; x < 3; ++x) column[(3 * k + x) * n] = sign * d[static_cast<Eigen::Index>(x)];
        }
      }
    }
  }
}

inline std::vector<std::size_t> ClosureEquations::columns_of(std::size_t closure) const {
  std::vector<std::size_t> columns;
  for (const Mover& mover : cycles_[closure].movers) columns.push_back(mover.column);
  std::sort(columns.begin(), columns.end());
  return columns;
}

inline double ClosureEquations::lever(std::size_t closure, std::size_t column) const noexcept {
  double farthest = 0.0;
  for (const Mover& mover : cycles_[closure].movers)
    if (mover.column == column)
      for (const Vec3& p : points(cycles_[closure], mover.moves_first))
        farthest = std::max(farthest, norm(Vec3(p - axes_[mover.group].point)));
  return farthest;
}

inline double ClosureEquations::longest_turn(std::span<const double> step) const noexcept {
  double longest = 0.0;
  for (std::size_t k = 0; k < columns(); ++k)
    if (groups_[id<GroupId>(column_group_[k])].joint.kind == JointKind::revolute)
      longest = std::max(longest, std::abs(step[k]));
  return longest;
}

inline void ClosureEquations::add(std::span<const double> step, double scale, std::span<double> q) const noexcept {
  for (std::size_t k = 0; k < columns(); ++k) q[column_dof_[k]] += scale * step[k];
}

inline void ClosureEquations::wrap(std::span<double> q) const noexcept {
  constexpr double turn = 2.0 * std::numbers::pi;
  for (std::size_t k = 0; k < columns(); ++k)
    if (double& value = q[column_dof_[k]]; groups_[id<GroupId>(column_group_[k])].joint.kind == JointKind::revolute)
      value -= turn * std::nearbyint(value / turn);
}

}  // namespace hinge
