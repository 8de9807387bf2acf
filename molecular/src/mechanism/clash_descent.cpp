// SPDX-License-Identifier: BSD-3-Clause
// Minimises the steric energy with NLopt.
#include "mechanism/clash_descent.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "hinge/core/finite.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/kinematics/rigid_groups.hpp"

namespace hinge::molecular {

namespace {

constexpr double closure_weight = 10.0;  // of squared residuals against squared overlaps
constexpr int most_evaluations = 300;
constexpr double smallest_move = 1e-4;  // angstrom; smaller steps end a descent

}  // namespace

ClashDescent::ClashDescent(Checker& checker, std::span<const double> start, std::span<const std::size_t> closures,
                           const std::function<bool()>& stop)
    : checker_(checker), stop_(stop), start_(start.begin(), start.end()) {
  if (!closures.empty()) equations_.emplace(checker.molecule().model().tree(), checker.selection(), closures);
  find_moved_atoms();
}

/// Sums over the atoms that each value moves, from the outermost groups to the root.
void ClashDescent::find_moved_atoms() {
  const RigidGroups& groups = checker_.rigid_groups();
  const Structure& s = checker_.molecule().structure();
  checker_.check(start_, Mode{});
  struct Sums {
    double count = 0.0, squares = 0.0;  // of |x - centre|^2
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    std::uint32_t least_residue = ~0U, largest_residue = 0;
  };
  std::vector<Sums> sums(groups.size());
  const Vec3 centre = checker_.position(0);
  for (std::uint32_t atom = 0; atom < s.atoms.size(); ++atom) {
    Sums& own = sums[index(checker_.group_of(atom))];
    const Vec3 x = checker_.position(atom) - centre;
    own.count += 1.0;
    own.squares += squared_norm(x);
    own.first += x;
    own.second += x * x.transpose();
    own.least_residue = std::min(own.least_residue, s.atoms[atom].residue);
    own.largest_residue = std::max(own.largest_residue, s.atoms[atom].residue);
  }
  std::vector<Pose> poses(groups.size());
  for (std::size_t g = 1; g < groups.size(); ++g) {
    const RigidGroup& group = groups[id<GroupId>(g)];
    poses[g] = poses[index(group.parent)] * group.joint.origin * motion(group.joint, start_[group.dof]);
  }
  moved_.assign(start_.size(), {});
  for (std::size_t g = groups.size(); g-- > 1;) {
    const RigidGroup& group = groups[id<GroupId>(g)];
    const Sums& own = sums[g];
    const Vec3 axis = product(poses[g].rotation, group.joint.axis);
    const Vec3 p = poses[g] * group.joint.point - centre;
    double inertia = own.count;
    if (group.joint.kind == JointKind::revolute) {
      const double along = dot(axis, p);
      inertia = own.squares - 2.0 * dot(p, own.first) + own.count * squared_norm(p) -
                dot(axis, product(own.second, axis)) + 2.0 * along * dot(axis, own.first) - own.count * along * along;
    }
    // An axis through all atoms that it moves changes nothing; any scale will do.
    if (inertia > 1e-3) moved_[group.dof].lever = std::sqrt(inertia);
    if (own.count > 0.0) moved_[group.dof].root_count = std::sqrt(own.count);
    moved_[group.dof].in_one_residue = own.least_residue >= own.largest_residue;
    Sums& parent = sums[index(group.parent)];
    parent.count += own.count;
    parent.squares += own.squares;
    parent.first += own.first;
    parent.second += own.second;
    parent.least_residue = std::min(parent.least_residue, own.least_residue);
    parent.largest_residue = std::max(parent.largest_residue, own.largest_residue);
  }
}

std::vector<double> ClashDescent::at(std::span<const double> u) const {
  std::vector<double> q(start_);
  for (std::size_t k = 0; k < q.size(); ++k) q[k] += u[k] / moved_[k].lever;
  return q;
}

double ClashDescent::objective(unsigned n, const double* u, double* gradient) {
  const std::vector<double> q = at({u, n});
  if (std::ranges::any_of(q, [](double x) { return !is_length(x); })) return HUGE_VAL;
  Steric steric = checker_.steric(q, softness);
  double value = steric.energy;
  if (equations_) {
    equations_->set(q);
    value += closure_weight * 2.0 * equations_->cost();
    if (gradient != nullptr) {
      equations_->compute_jacobian();
      const std::size_t columns = equations_->columns();
      for (std::size_t row = 0; row < equations_->rows(); ++row)
        for (std::size_t c = 0; c < columns; ++c)
          steric.gradient[equations_->position(c)] +=
              closure_weight * 2.0 * equations_->residuals()[row] * equations_->jacobian()[row * columns + c];
    }
  }
  for (unsigned k = 0; k < n; ++k) {
    value += mu_ * u[k] * u[k];
    if (gradient != nullptr) gradient[k] = steric.gradient[k] / moved_[k].lever + 2.0 * mu_ * u[k];
  }
  return value;
}

double ClashDescent::call(unsigned n, const double* u, double* gradient, void* self) noexcept {
  auto& descent = *static_cast<ClashDescent*>(self);
  try {
    descent.stopped_ = descent.stopped_ || (descent.stop_ && descent.stop_());
    if (descent.stopped_) nlopt_force_stop(descent.optimiser_);
    return descent.objective(n, u, gradient);
  } catch (...) {
    descent.error_ = std::current_exception();
    nlopt_force_stop(descent.optimiser_);
    return HUGE_VAL;
  }
}

void ClashDescent::minimise(std::vector<double>& q, double mu) {
  const auto n = static_cast<unsigned>(q.size());
  std::vector<double> u(n);
  for (std::size_t k = 0; k < n; ++k) u[k] = (q[k] - start_[k]) * moved_[k].lever;
  mu_ = mu;
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimiser(nlopt_create(NLOPT_LD_LBFGS, n),
                                                                         &nlopt_destroy);
  optimiser_ = optimiser.get();
  nlopt_set_min_objective(optimiser_, &ClashDescent::call, this);
  nlopt_set_xtol_abs1(optimiser_, smallest_move);
  nlopt_set_maxeval(optimiser_, most_evaluations);
  double value = 0.0;
  // A negative status says that rounding or stop() ended the descent; u is the best point then, too.
  nlopt_optimize(optimiser_, u.data(), &value);
  if (error_) std::rethrow_exception(error_);
  q = at(u);
}

}  // namespace hinge::molecular
