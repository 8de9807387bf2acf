// SPDX-License-Identifier: BSD-3-Clause
// Minimises the distance to given coordinates.
#include "hinge/molecular/fit_coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/kinematics/closure_solver.hpp"
#include "hinge/molecular/fit_torsions.hpp"
#include "mechanism/clash_descent.hpp"
#include "mechanism/minimise.hpp"
#include "mechanism/moved_atoms.hpp"
#include "mechanism/superpose.hpp"

namespace hinge::molecular {

namespace {

constexpr double exact_from = 1e-3;  // angstrom: the rounding of a file
constexpr int most_fit_evaluations = 2000;
constexpr double open_closure_weight = 100.0;  // of squared residuals against the sum of squared distances

class CoordinateFitter {
 public:
  CoordinateFitter(const Checker& checker, const TargetCoordinates& target, std::span<const std::size_t> closures,
                   const std::function<bool()>& stop);

  CoordinateFit run() {
    const std::vector<double> reference(checker_.dof_count(), 0.0), turned = by_torsions();
    CoordinateFit best = measured(reference);
    const auto offer = [&](std::vector<double> q) {
      if (solver_ && !solver_->close(q)) return;
      CoordinateFit found = measured(std::move(q));
      if (found.rmsd < best.rmsd) best = std::move(found);
    };
    offer(turned);
    if (best.rmsd > exact_from) {
      offer(descend(reference));
      offer(descend(turned));
    }
    best.stopped = minimiser_.stopped();
    return best;
  }

 private:
  void validate() const {
    if (target_.atoms.empty()) throw ModelError("the target has no atoms, expected at least one");
    if (target_.atoms.size() != target_.positions.size())
      throw ModelError("the target has " + std::to_string(target_.atoms.size()) + " atoms and " +
                       std::to_string(target_.positions.size()) + " positions, expected as many");
    const std::size_t count = checker_.molecule().structure().atoms.size();
    for (std::size_t k = 0; k < target_.atoms.size(); ++k) {
      if (target_.atoms[k] >= count)
        throw ModelError("atom " + std::to_string(target_.atoms[k]) + " of the target: expected less than " +
                         std::to_string(count));
      for (int axis = 0; axis < 3; ++axis)
        if (!is_length(target_.positions[k][axis]))
          throw ConfigurationError("position " + std::to_string(k) + " of the target is " +
                                   number_text(target_.positions[k][axis]) + ", expected a finite length");
    }
  }

  /// Returns the torsions of the target, and placements that superpose the parts, as far as they are known.
  std::vector<double> by_torsions();
  std::vector<double> descend(const std::vector<double>& start);
  /// Returns the sum of squared distances at q, with open closures, and its derivatives.
  double objective(const std::vector<double>& q, std::vector<double>& gradient);
  /// Computes the poses of the groups at q, the target's atoms there, and the rotation of the target onto them.
  void place(std::span<const double> q);
  CoordinateFit measured(std::vector<double> q);

  Checker checker_;
  const TargetCoordinates& target_;
  Minimiser minimiser_;
  std::optional<ClosureEquations> equations_;
  std::optional<ClosureSolver> solver_;
  std::vector<std::size_t> group_;  // of each atom of the target
  std::vector<Vec3> local_;         // its position in the frame of the group
  Vec3 target_centre_;
  // At the configuration of the last place():
  std::vector<Pose> poses_;
  std::vector<Vec3> here_;  // the target's atoms
  Vec3 centre_here_ = Vec3::Zero();
  Mat3 rotation_ = Mat3::Identity();  // from the target
};

CoordinateFitter::CoordinateFitter(const Checker& checker, const TargetCoordinates& target,
                                   std::span<const std::size_t> closures, const std::function<bool()>& stop)
    : checker_(checker), target_(target), minimiser_(stop) {
  validate();
  target_centre_ = centre(target.positions);
  const std::vector<double> reference(checker.dof_count(), 0.0);
  const std::vector<Pose> poses = group_poses(checker_.rigid_groups(), reference);
  const std::vector<Vec3>& positions = checker.molecule().structure().models.front();
  for (const std::uint32_t atom : target.atoms) {
    group_.push_back(index(checker.group_of(atom)));
    const Pose& pose = poses[group_.back()];
    local_.push_back(product(Mat3(pose.rotation.transpose()), Vec3(positions[atom] - pose.translation)));
  }
  here_.resize(target.atoms.size());
  if (closures.empty()) return;
  const KinematicTree& tree = checker.molecule().model().tree();
  equations_.emplace(tree, checker.selection(), closures);
  solver_.emplace(tree, checker.selection(), closures);
}

void CoordinateFitter::place(std::span<const double> q) {
  poses_ = group_poses(checker_.rigid_groups(), q);
  for (std::size_t k = 0; k < here_.size(); ++k) here_[k] = poses_[group_[k]] * local_[k];
  centre_here_ = centre(here_);
  rotation_ = closest_rotation(target_.positions, target_centre_, here_, centre_here_);
}

CoordinateFit CoordinateFitter::measured(std::vector<double> q) {
  place(q);
  const Superposition found = superpose(here_, target_.positions);
  return {std::move(q), found.rmsd, found.farthest, target_.atoms[found.atom], false};
}

std::vector<double> CoordinateFitter::by_torsions() {
  const Molecule& molecule = checker_.molecule();
  const std::size_t atoms = molecule.structure().atoms.size();
  std::vector<Vec3> positions(atoms, Vec3::Zero());
  std::vector<bool> known(atoms, false);
  for (std::size_t k = 0; k < target_.atoms.size(); ++k) {
    positions[target_.atoms[k]] = target_.positions[k];
    known[target_.atoms[k]] = true;
  }
  const auto dofs = checker_.selection().dofs();
  std::vector<double> q(dofs.size(), 0.0);
  for (std::size_t k = 0; k < q.size(); ++k) {
    const std::size_t torsion = molecule.torsion_of(dofs[k]);
    if (torsion == Molecule::no_torsion) continue;
    const auto& four = molecule.torsions()[torsion].atoms;
    if (!std::ranges::all_of(four, [&](std::uint32_t atom) { return known[atom]; })) continue;
    const double angle = dihedral(positions[four[0]], positions[four[1]], positions[four[2]], positions[four[3]]);
    if (!std::isnan(angle)) q[k] = turn_of(molecule, torsion, positions);
  }
  if (molecule.placed_parts().empty()) return q;
  // A part is superposed after its own torsions are set.
  checker_.check(q, Mode{});
  const auto placements = fit_placements(molecule, checker_.positions(), positions, known);
  for (std::size_t part = 0; part < placements.size(); ++part)
    for (std::size_t c = 0; c < 6; ++c) {
      const auto dof = std::ranges::find(dofs, molecule.placed_parts()[part].dofs[c]);
      if (dof != dofs.end()) q[static_cast<std::size_t>(dof - dofs.begin())] = placements[part][c];
    }
  return q;
}

double CoordinateFitter::objective(const std::vector<double>& q, std::vector<double>& gradient) {
  place(q);
  const RigidGroups& groups = checker_.rigid_groups();
  std::vector<Vec3> force(groups.size(), Vec3::Zero()), moment(groups.size(), Vec3::Zero());
  double value = 0.0;
  for (std::size_t k = 0; k < here_.size(); ++k) {
    const Vec3 x = here_[k] - centre_here_;
    const Vec3 away = x - product(rotation_, Vec3(target_.positions[k] - target_centre_));
    value += squared_norm(away);
    // The superposition is optimal, so its own change adds nothing to the derivatives.
    force[group_[k]] += 2.0 * away;
    moment[group_[k]] += 2.0 * cross(x, away);
  }
  gradient = gradient_by_values(groups, poses_, centre_here_, force, moment, q.size());
  if (equations_) value += add_closures(*equations_, open_closure_weight, q, gradient);
  return value;
}

std::vector<double> CoordinateFitter::descend(const std::vector<double>& start) {
  const std::vector<MovedAtoms> moved = find_moved_atoms(checker_, start);
  std::vector<double> q, gradient, u(start.size(), 0.0);
  const auto at = [&](std::span<const double> displacements) {
    q = start;
    for (std::size_t k = 0; k < q.size(); ++k) q[k] += displacements[k] / moved[k].lever;
  };
  minimiser_.minimise(
      u,
      [&](std::span<const double> displacements, std::span<double> slopes) {
        at(displacements);
        if (std::ranges::any_of(q, [](double x) { return !is_length(x); })) return HUGE_VAL;
        const double value = objective(q, gradient);
        for (std::size_t k = 0; k < slopes.size(); ++k) slopes[k] = gradient[k] / moved[k].lever;
        return value;
      },
      most_fit_evaluations);
  at(u);
  return q;
}

}  // namespace

CoordinateFit fit_coordinates(const Checker& checker, const TargetCoordinates& target,
                              std::span<const std::size_t> closures, const std::function<bool()>& stop) {
  CoordinateFit found = CoordinateFitter(checker, target, closures, stop).run();
  const auto dofs = checker.selection().dofs();
  const std::vector<double> reference(1, 0.0);
  for (std::size_t k = 0; k < dofs.size(); ++k)
    if (checker.molecule().torsion_of(dofs[k]) != Molecule::no_torsion)
      take_shorter_way(reference, std::span(found.q).subspan(k, 1));
  return found;
}

}  // namespace hinge::molecular
