// SPDX-License-Identifier: BSD-3-Clause
// The loose end of ubiquitin from one conformation to another, planned by OMPL; every motion is proved free.
#include <hinge/molecular/checker.hpp>
#include <hinge/molecular/path_checker.hpp>
#include <hinge/molecular/read_structure.hpp>
#include <hinge/molecular/sampler.hpp>
#include <hinge/molecular/selection.hpp>

#include <ompl/base/MotionValidator.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

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

using Space = ob::RealVectorStateSpace;

std::span<const double> turns(const ob::State* state, std::size_t count) {
  return {state->as<Space::StateType>()->values, count};
}

// One of each per thread, as for robots.
class ConformationIsFree : public ob::StateValidityChecker {
 public:
  ConformationIsFree(const ob::SpaceInformationPtr& space, const Checker& checker)
      : ob::StateValidityChecker(space), checker_(checker) {}
  bool isValid(const ob::State* state) const override {
    return si_->satisfiesBounds(state) &&
           !checker_.check(turns(state, checker_.dof_count()), Mode{Mode::Kind::any}).collides;
  }

 private:
  mutable Checker checker_;
};

class MotionIsFree : public ob::MotionValidator {
 public:
  MotionIsFree(const ob::SpaceInformationPtr& space, const Checker& checker)
      : ob::MotionValidator(space), paths_(checker) {}
  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    const std::size_t n = si_->getStateDimension();
    return si_->satisfiesBounds(to) && paths_.certify(turns(from, n), turns(to, n)).is_free();
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
  const auto ubiquitin = std::make_shared<const Molecule>(read_structure("molecular/data/1ubq.pdb"));
  const auto end = ubiquitin->select(select_torsions(*ubiquitin, "A:73-76:backbone", false));
  CheckOptions options;
  options.exempt_reference = true;  // what touches in the crystal may
  Checker checker(ubiquitin, end, options);
  PathChecker paths(checker);

  // A conformation to go to: free, and not on a straight way from the reference.
  const std::vector<double> reference(checker.dof_count(), 0.0);
  std::vector<double> goal;
  for (std::uint64_t k = 0; goal.empty(); ++k) {
    const std::vector<double> q = sample_configuration({2005, {}}, k, checker.dof_count());
    if (!checker.check(q, Mode{Mode::Kind::any}).collides && !paths.certify(reference, q).is_free()) goal = q;
  }

  const auto space = std::make_shared<Space>(checker.dof_count());
  space->setBounds(-std::numbers::pi, std::numbers::pi);
  ompl::geometric::SimpleSetup setup(space);
  const auto information = setup.getSpaceInformation();
  setup.setStateValidityChecker(std::make_shared<ConformationIsFree>(information, checker));
  information->setMotionValidator(std::make_shared<MotionIsFree>(information, checker));
  const auto planner = std::make_shared<ompl::geometric::RRTConnect>(information);
  planner->setRange(1.0);  // rad, over all torsions
  setup.setPlanner(planner);
  ob::ScopedState<Space> first(space), last(space);
  first = reference;
  last = goal;
  setup.setStartAndGoalStates(first, last);
  if (setup.solve(20.0) != ob::PlannerStatus::EXACT_SOLUTION) return 1;

  auto path = setup.getSolutionPath();
  const std::size_t corners = path.getStateCount();
  path.interpolate(1000);
  for (const ob::State* state : path.getStates())
    if (checker.check(turns(state, checker.dof_count()), Mode{Mode::Kind::any}).collides) return 1;
  std::printf("%zu motions of %zu torsions, each proved free; %zu states of them, none collides\n", corners - 1,
              checker.dof_count(), path.getStateCount());
  return 0;
}
