// SPDX-License-Identifier: BSD-3-Clause
// ConformationProblem: a motion between two conformations, as a planner needs it.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "hinge/kinematics/closure_equations.hpp"
#include "hinge/kinematics/closure_solver.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/path_checker.hpp"
#include "hinge_planning/motion_problem.hpp"

namespace hinge::molecular {

/// Motions of a molecule between two conformations. With closures, a motion goes in closed steps.
class ConformationProblem {
 public:
  static constexpr double closed_tolerance = 1e-6;  ///< angstrom

  /// closures: indices in the tree's to keep.
  ConformationProblem(const Checker& checker, std::span<const std::size_t> closures);

  /// Returns the problem of a motion between two conformations. It refers to this object, and is valid until the next
  /// call.
  planning::MotionProblem between(std::span<const double> from, std::span<const double> to);
  /// Distance of the two conformations of between(): root mean square displacement of all atoms, linear in the values.
  double straight() const noexcept { return straight_; }
  /// Returns the largest residual at the configuration, angstrom; 0 without closures.
  double residual(std::span<const double> q) {
    if (!equations_) return 0.0;
    equations_->set(q);
    return equations_->worst();
  }
  /// True if the straight path is proved free.
  bool is_certified(std::span<const double> from, std::span<const double> to) {
    return paths_.certify(from, to).is_free();
  }
  /// True if the motion is proved free.
  bool is_motion_free(std::span<const double> from, std::span<const double> to);
  bool is_closed(std::span<const double> q) { return residual(q) <= closed_tolerance; }

 private:
  /// Returns the root mean square displacement of all atoms, linear in the values; angles take the shorter way.
  double distance(std::span<const double> a, std::span<const double> b) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += std::pow(weights_[k] * change(k, a, b), 2);
    return std::sqrt(sum);
  }
  /// Returns the configuration of `to` that the motion from `from` ends at: no angle changes by more than half a turn.
  std::vector<double> end_of(std::span<const double> from, std::span<const double> to) const {
    std::vector<double> end(from.begin(), from.end());
    for (std::size_t k = 0; k < end.size(); ++k) end[k] += change(k, from, to);
    return end;
  }
  double largest_distance() const;
  void draw(SampleStream& stream, std::span<double> q);
  void go(std::span<const double> from, std::span<const double> to, double share, std::span<double> q);
  std::vector<std::vector<double>> steps(std::span<const double> from, std::span<const double> to);
  /// The change of a value from a to b; an angle takes the shorter way round.
  double change(std::size_t k, std::span<const double> a, std::span<const double> b) const {
    return turns_[k] ? std::remainder(b[k] - a[k], 2.0 * std::numbers::pi) : b[k] - a[k];
  }
  /// Closes the cycles of q; angles stay within half a turn of where they were.
  bool close(std::vector<double>& q);
  /// Walks from `from` towards `to` in `count` closed steps and calls step(q) for the first `last` of them. Returns
  /// false if a step does not close or jumps.
  template <class Step>
  bool walk(std::span<const double> from, std::span<const double> to, std::size_t count, std::size_t last,
            const Step& step);
  std::size_t count_steps(std::span<const double> from, std::span<const double> to) const;

  Checker checker_;
  PathChecker paths_;
  std::vector<double> from_, to_;
  std::vector<double> weights_;  // angstrom per rad, or 1
  std::vector<bool> turns_;
  double straight_ = 0.0;
  std::optional<ClosureEquations> equations_;
  std::optional<ClosureSolver> solver_;
};

}  // namespace hinge::molecular
