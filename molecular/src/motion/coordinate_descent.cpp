// SPDX-License-Identifier: BSD-3-Clause
// Minimises distances from given coordinates.
#include "motion/coordinate_descent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "motion/clash_descent.hpp"
#include "motion/moved_atoms.hpp"
#include "motion/superpose.hpp"

namespace hinge::molecular {

namespace {

constexpr double open_closure_weight = 100.0;  // of squared residuals against the sum of squared distances
// Of the distances against the steric energy, largest first.
constexpr std::array target_weights{1.0, 1e-1, 1e-2, 1e-3, 1e-4};

}  // namespace

void check_target(const Checker& checker, const TargetCoordinates& target) {
  if (target.atoms.empty()) throw ModelError("the target has no atoms, expected at least one");
  if (target.atoms.size() != target.positions.size())
    throw ModelError("the target has " + std::to_string(target.atoms.size()) + " atoms and " +
                     std::to_string(target.positions.size()) + " positions, expected as many");
  const std::size_t count = checker.molecule().structure().atoms.size();
  for (std::size_t k = 0; k < target.atoms.size(); ++k) {
    if (target.atoms[k] >= count)
      throw ModelError("atom " + std::to_string(target.atoms[k]) + " of the target: expected less than " +
                       std::to_string(count));
    for (int axis = 0; axis < 3; ++axis)
      if (!is_length(target.positions[k][axis]))
        throw ConfigurationError("position " + std::to_string(k) + " of the target is " +
                                 number_text(target.positions[k][axis]) + ", expected a finite length");
  }
}

CoordinateDescent::CoordinateDescent(Checker& checker, const TargetCoordinates& target,
                                     std::span<const std::size_t> closures, const std::function<bool()>& stop)
    : checker_(checker), minimiser_(stop), here_(target.atoms.size()) {
  check_target(checker, target);
  aim(target.positions);
  const std::vector<Vec3> local = positions_in_groups(checker);
  for (const std::uint32_t atom : target.atoms) {
    group_.push_back(index(checker.group_of(atom)));
    local_.push_back(local[atom]);
  }
  if (closures.empty()) return;
  const KinematicTree& tree = checker.molecule().model().tree();
  equations_.emplace(tree, checker.selection(), closures);
  solver_.emplace(tree, checker.selection(), closures);
}

void CoordinateDescent::aim(std::vector<Vec3> positions) {
  target_ = std::move(positions);
  target_centre_ = centre(target_);
}

const std::vector<Vec3>& CoordinateDescent::place(std::span<const double> q) {
  poses_ = group_poses(checker_.rigid_groups(), q);
  for (std::size_t k = 0; k < here_.size(); ++k) here_[k] = poses_[group_[k]] * local_[k];
  return here_;
}

void CoordinateDescent::superpose_target() {
  centre_ = centre(here_);
  rotation_ = closest_rotation(target_, target_centre_, here_, centre_);
}

double CoordinateDescent::rmsd(std::span<const double> q) {
  place(q);
  superpose_target();
  double sum = 0.0;
  for (std::size_t k = 0; k < here_.size(); ++k) sum += squared_norm(away(k));
  return std::sqrt(sum / static_cast<double>(here_.size()));
}

void CoordinateDescent::approach(std::vector<double>& q, int evaluations) {
  minimise(q, 1.0, Clashes::ignored, evaluations, {});
}

bool CoordinateDescent::make_free(std::vector<double>& q, int evaluations, double stiffness) {
  const std::vector<double> start = q;
  for (const double weight : target_weights) {
    minimise(q, weight, Clashes::avoided, evaluations, {start, weight * stiffness});
    if (stopped()) return false;
    std::vector<double> reached = q;
    if (!close(reached) || !checker_.check(reached, Mode{Mode::Kind::within, file_rounding}).pairs.empty()) continue;
    q = std::move(reached);
    return true;
  }
  return false;
}

double CoordinateDescent::objective(std::span<const double> q, double weight, Clashes clashes,
                                    std::vector<double>& gradient) {
  place(q);
  superpose_target();
  const RigidGroups& groups = checker_.rigid_groups();
  std::vector<Vec3> force(groups.size(), Vec3::Zero()), moment(groups.size(), Vec3::Zero());
  double value = 0.0;
  for (std::size_t k = 0; k < here_.size(); ++k) {
    const Vec3 off = away(k);
    value += weight * squared_norm(off);
    // The superposition is optimal, so its own change adds nothing to the derivatives.
    force[group_[k]] += 2.0 * weight * off;
    moment[group_[k]] += 2.0 * weight * cross(Vec3(here_[k] - centre_), off);
  }
  gradient = gradient_by_values(groups, poses_, centre_, force, moment, q.size());
  if (equations_)
    value += add_closures(*equations_, clashes == Clashes::ignored ? open_closure_weight : 10.0, q, gradient);
  if (clashes == Clashes::ignored) return value;
  const Steric steric = checker_.steric(q, ClashDescent::softness);
  for (std::size_t k = 0; k < gradient.size(); ++k) gradient[k] += steric.gradient[k];
  return value + steric.energy;
}

void CoordinateDescent::minimise(std::vector<double>& q, double weight, Clashes clashes, int evaluations,
                                 const Pull& pull) {
  const std::vector<MovedAtoms> moved = find_moved_atoms(checker_, q);
  const std::vector<double> start = q;
  std::vector<double> gradient, u(q.size(), 0.0);
  const auto at = [&](std::span<const double> displacements) {
    for (std::size_t k = 0; k < q.size(); ++k) q[k] = start[k] + displacements[k] / moved[k].lever;
  };
  minimiser_.minimise(
      u,
      [&](std::span<const double> displacements, std::span<double> slopes) {
        at(displacements);
        if (std::ranges::any_of(q, [](double x) { return !is_length(x); })) return HUGE_VAL;
        double value = objective(q, weight, clashes, gradient);
        for (std::size_t k = 0; k < pull.start.size(); ++k) {
          const double off = q[k] - pull.start[k];
          value += pull.stiffness * off * off;
          gradient[k] += 2.0 * pull.stiffness * off;
        }
        for (std::size_t k = 0; k < slopes.size(); ++k) slopes[k] = gradient[k] / moved[k].lever;
        return value;
      },
      evaluations);
  at(u);
}

}  // namespace hinge::molecular
