// SPDX-License-Identifier: BSD-3-Clause
// Moves a loop of ubiquitin from one conformation to another with both ends held. OMPL plans on the set of closed
// loops, and every step of every motion is proved free.
#include <hinge/kinematics/closure_equations.hpp>
#include <hinge/kinematics/closure_solver.hpp>
#include <hinge/molecular/checker.hpp>
#include <hinge/molecular/closed_sampler.hpp>
#include <hinge/molecular/loop.hpp>
#include <hinge/molecular/path_checker.hpp>
#include <hinge/molecular/read_structure.hpp>

#include <ompl/base/ConstrainedSpaceInformation.h>
#include <ompl/base/Constraint.h>
#include <ompl/base/MotionValidator.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/constraint/ProjectedStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

using namespace hinge::molecular;
namespace ob = ompl::base;

using Space = ob::ProjectedStateSpace;

std::span<const double> turns(const ob::State* state) {
  const Eigen::Map<Eigen::VectorXd>& values = *state->as<Space::StateType>();
  return {values.data(), static_cast<std::size_t>(values.size())};
}

// The closure equations, in angstrom; they are 0 if the loop is closed.
class LoopIsClosed : public ob::Constraint {
 public:
  static constexpr double tolerance = 1e-6;

  LoopIsClosed(const hinge::KinematicTree& tree, const hinge::DofSelection& selection)
      : LoopIsClosed(hinge::ClosureEquations(tree, selection), hinge::ClosureSolver(tree, selection),
                     selection.size()) {}
  void function(const Eigen::Ref<const Eigen::VectorXd>& q, Eigen::Ref<Eigen::VectorXd> out) const override {
    equations_.set({q.data(), static_cast<std::size_t>(q.size())});
    out = Eigen::Map<const Eigen::VectorXd>(equations_.residuals().data(), out.size());
  }
  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& q, Eigen::Ref<Eigen::MatrixXd> out) const override {
    equations_.set({q.data(), static_cast<std::size_t>(q.size())});
    equations_.compute_jacobian();
    out.setZero();  // columns of torsions outside all cycles stay 0
    for (std::size_t row = 0; row < equations_.rows(); ++row)
      for (std::size_t column = 0; column < equations_.columns(); ++column)
        out(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(equations_.position(column))) =
            equations_.jacobian()[row * equations_.columns() + column];
  }
  // Uses Hinge's solver, because the equations of a loop are redundant and OMPL's solver may return wrapped angles.
  bool project(Eigen::Ref<Eigen::VectorXd> q) const override {
    const Eigen::VectorXd start = q;
    const bool closed = solver_.close({q.data(), static_cast<std::size_t>(q.size())});
    constexpr double turn = 2 * std::numbers::pi;
    q.array() += turn * ((start - q).array() / turn).round();
    return closed;
  }

 private:
  LoopIsClosed(hinge::ClosureEquations equations, hinge::ClosureSolver solver, std::size_t dofs)
      : ob::Constraint(static_cast<unsigned>(dofs), static_cast<unsigned>(equations.rows()), tolerance),
        equations_(std::move(equations)),
        solver_(std::move(solver)) {}

  mutable hinge::ClosureEquations equations_;
  mutable hinge::ClosureSolver solver_;
};

// One object per thread: a checker holds its last state.
class ConformationIsFree : public ob::StateValidityChecker {
 public:
  ConformationIsFree(const ob::SpaceInformationPtr& space, const Checker& checker)
      : ob::StateValidityChecker(space), checker_(checker) {}
  bool isValid(const ob::State* state) const override {
    return si_->satisfiesBounds(state) && !checker_.check(turns(state), Mode{Mode::Kind::any}).collides;
  }

 private:
  mutable Checker checker_;
};

// OMPL walks along the closed set in steps of delta. Between two steps, the path is straight.
class MotionIsFree : public ob::MotionValidator {
 public:
  MotionIsFree(const ob::SpaceInformationPtr& space, const Checker& checker)
      : ob::MotionValidator(space), paths_(checker) {}
  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    const auto* space = si_->getStateSpace()->as<Space>();
    std::vector<ob::State*> steps;
    bool free = si_->isValid(to) && space->discreteGeodesic(from, to, false, &steps);
    for (std::size_t k = 0; free && k < steps.size(); ++k)
      free = paths_.certify(turns(steps[k]), turns(k + 1 < steps.size() ? steps[k + 1] : to)).is_free();
    for (ob::State* step : steps) space->freeState(step);
    return free;
  }
  bool checkMotion(const ob::State* from, const ob::State* to, std::pair<ob::State*, double>& last) const override {
    if (checkMotion(from, to)) return true;
    if (last.first != nullptr) si_->copyState(last.first, from);
    last.second = 0.0;
    return false;
  }

 private:
  mutable PathChecker paths_;
};

int main() {
  ompl::msg::noOutputHandler();
  ompl::RNG::setSeed(1);
  Structure structure = read_structure("molecular/data/1ubq.pdb");
  MoleculeOptions loops;
  loops.loops = find_loops(structure, "A:6-13");
  const auto ubiquitin = std::make_shared<const Molecule>(std::move(structure), loops);
  const hinge::DofSelection selection = ubiquitin->select(select_loop_torsions(*ubiquitin, "none", false));
  CheckOptions options;
  options.exempt_reference = true;  // exempts pairs that touch in the crystal
  Checker checker(ubiquitin, selection, options);
  const std::size_t dofs = checker.dof_count();

  // A closed conformation as goal, with at least one torsion that changes by more than 1 rad.
  const std::vector<double> reference(dofs, 0.0);
  ClosedSampler sampler(*ubiquitin, selection, {2005, 0.5}, 100);
  std::vector<double> goal;
  for (std::uint64_t k = 0; goal.empty(); ++k) {
    const ClosedSample sample = sampler.sample(k);
    const auto far = [](double turn) { return std::abs(turn) > 1.0; };
    if (std::ranges::any_of(sample.q, far) && !checker.check(sample.q, Mode{Mode::Kind::any}).collides) goal = sample.q;
  }

  const auto turning = std::make_shared<ob::RealVectorStateSpace>(dofs);
  turning->setBounds(-std::numbers::pi, std::numbers::pi);
  const auto closed = std::make_shared<LoopIsClosed>(ubiquitin->model().tree(), selection);
  const auto space = std::make_shared<Space>(turning, closed);
  const auto information = std::make_shared<ob::ConstrainedSpaceInformation>(space);
  ompl::geometric::SimpleSetup setup(information);
  space->setDelta(0.1);  // rad, over all torsions
  setup.setStateValidityChecker(std::make_shared<ConformationIsFree>(information, checker));
  information->setMotionValidator(std::make_shared<MotionIsFree>(information, checker));
  const auto planner = std::make_shared<ompl::geometric::RRTConnect>(information);
  planner->setRange(1.0);
  setup.setPlanner(planner);
  ob::ScopedState<> first(space), last(space);
  const auto put = [](const std::vector<double>& q, ob::ScopedState<>& state) {
    state->as<Space::StateType>()->copy(
        Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size())));
  };
  put(reference, first);
  put(goal, last);
  setup.setStartAndGoalStates(first, last);
  if (setup.solve(60.0) != ob::PlannerStatus::EXACT_SOLUTION) return 1;

  auto path = setup.getSolutionPath();
  const std::size_t corners = path.getStateCount();
  path.interpolate();
  double closed_to = 0.0, between = 0.0;  // angstrom
  std::span<const double> before = reference;
  for (const ob::State* state : path.getStates()) {
    const std::span<const double> q = turns(state);
    const Verdict verdict = checker.check(q, Mode{Mode::Kind::any});
    if (verdict.collides) return 1;
    closed_to = std::max(closed_to, verdict.closure_residual);
    std::vector<double> half(dofs);
    for (std::size_t k = 0; k < dofs; ++k) half[k] = 0.5 * (before[k] + q[k]);
    between = std::max(between, checker.check(half, Mode{Mode::Kind::any}).closure_residual);
    before = q;
  }
  std::printf("%zu motions of %zu torsions, each proved free; %zu states of them, none collides\n", corners - 1, dofs,
              path.getStateCount());
  std::printf("closed to %.1g A in each of them, to %.1g A half way between two\n", closed_to, between);
  return closed_to < LoopIsClosed::tolerance && between < 0.01 ? 0 : 1;
}
