// SPDX-License-Identifier: BSD-3-Clause
// OmplPlanner: OMPL as most programs use it. A motion is tested at states a fixed fraction of the space apart.
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge_planning/joint_space.hpp"
#include "hinge_planning/motion_problem.hpp"

namespace hinge::bench {

/// Returns the Euclidean distance of two configurations.
inline double euclidean(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

struct OmplMotion {
  std::vector<std::vector<double>> waypoints;  ///< empty if none was found
  std::uint64_t states = 0;                    ///< that were tested
  double length = 0.0;                         ///< as the metric counts
};

/// RRT-Connect and the simplifier of OMPL with their defaults. Configurations are uniform between lower and upper, and
/// their distance is Euclidean. resolution: distance of tested states as a share of the space's diagonal; OMPL's
/// default is 0.01.
class OmplPlanner {
 public:
  using IsFree = std::function<bool(std::span<const double>)>;

  OmplPlanner(std::vector<double> lower, std::vector<double> upper, IsFree is_free, double resolution)
      : lower_(std::move(lower)), upper_(std::move(upper)), is_free_(std::move(is_free)), resolution_(resolution) {
    problem_.dof_count = lower_.size();
    problem_.distance = euclidean;
    problem_.largest_distance = problem_.distance(lower_, upper_);
    problem_.draw = [this](SampleStream& stream, std::span<double> q) {
      for (std::size_t k = 0; k < q.size(); ++k) q[k] = lower_[k] + stream.uniform() * (upper_[k] - lower_[k]);
    };
  }

  OmplMotion plan(const std::vector<double>& from, const std::vector<double>& to, std::uint64_t seed,
                  double seconds) const {
    namespace ob = ompl::base;
    namespace og = ompl::geometric;
    OmplMotion motion;
    const auto information =
        std::make_shared<ob::SpaceInformation>(std::make_shared<planning::JointSpace>(problem_, seed));
    information->setStateValidityChecker([&](const ob::State* state) {
      ++motion.states;
      return is_free_(planning::JointSpace::values(state));
    });
    information->setStateValidityCheckingResolution(resolution_);
    information->setup();
    const auto definition = std::make_shared<ob::ProblemDefinition>(information);
    const auto state = [&](const std::vector<double>& q) {
      ob::ScopedState<> made(information);
      std::ranges::copy(q, planning::JointSpace::values(made.get()).begin());
      return made;
    };
    definition->setStartAndGoalStates(state(from), state(to));
    og::RRTConnect planner(information);
    planner.setProblemDefinition(definition);
    planner.setup();
    if (planner.solve(ob::timedPlannerTerminationCondition(seconds)) != ob::PlannerStatus::EXACT_SOLUTION)
      return motion;
    og::PathGeometric& path = *definition->getSolutionPath()->as<og::PathGeometric>();
    og::PathSimplifier(information).simplifyMax(path);
    motion.length = path.length();
    for (const ob::State* s : path.getStates()) {
      const std::span<const double> values = planning::JointSpace::values(s);
      motion.waypoints.emplace_back(values.begin(), values.end());
    }
    return motion;
  }

 private:
  std::vector<double> lower_, upper_;
  IsFree is_free_;
  double resolution_;
  planning::MotionProblem problem_;
};

}  // namespace hinge::bench
