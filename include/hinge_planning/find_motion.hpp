// SPDX-License-Identifier: BSD-3-Clause
// find_motion: finds a free motion between two configurations with OMPL's RRT-Connect, and shortens it.
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/Planner.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateSampler.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge_planning/joint_space.hpp"
#include "hinge_planning/motion_problem.hpp"

namespace hinge::planning {

/// Options of find_motion().
struct MotionSearch {
  double range = 1.0;               ///< longest motion that is added to a tree, in the unit of MotionProblem::distance
  std::uint64_t most_motions = 1;   ///< largest number of motions to test before a first solution
  std::uint64_t seed = 1;           ///< of the random configurations
  std::function<bool()> stop = {};  ///< called before every draw and motion; if it returns true, the search ends
};

using Waypoints = std::vector<std::vector<double>>;

/// The result of find_motion() and connect().
struct FoundMotion {
  /// Configurations from the start on; the motion between neighbours is free. The last one is the end if it was
  /// reached, otherwise the nearest to it that was reached.
  Waypoints waypoints;
  bool reached = false;       ///< the last waypoint is the end
  double remaining = 0.0;     ///< of find_motion(): distance from the last waypoint to the end; 0 if reached
  std::uint64_t motions = 0;  ///< motions that were tested, those of shortening included
};

namespace detail {

class StateIsFree : public ompl::base::StateValidityChecker {
 public:
  StateIsFree(const ompl::base::SpaceInformationPtr& information, const MotionProblem& problem)
      : ompl::base::StateValidityChecker(information), problem_(problem) {}
  bool isValid(const ompl::base::State* state) const override { return problem_.is_free(JointSpace::values(state)); }

 private:
  const MotionProblem& problem_;
};

/// A motion is valid if all of it is proved free. After the search was stopped, none is: RRT-Connect asks nothing else
/// while one tree grows towards the other.
class MotionIsFree : public ompl::base::MotionValidator {
 public:
  MotionIsFree(const ompl::base::SpaceInformationPtr& information, const MotionProblem& problem,
               std::function<bool()> stop)
      : ompl::base::MotionValidator(information), problem_(problem), stop_(std::move(stop)) {}
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override {
    const bool free = !(stop_ && stop_()) && problem_.is_motion_free(JointSpace::values(from), JointSpace::values(to));
    ++(free ? valid_ : invalid_);
    return free;
  }
  /// Of a motion that is not free only the start is known to be free.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last) const override {
    if (checkMotion(from, to)) return true;
    if (last.first != nullptr) si_->copyState(last.first, from);
    last.second = 0.0;
    return false;
  }

 private:
  const MotionProblem& problem_;
  std::function<bool()> stop_;
};

/// OMPL's simplifier with a seed of its own.
class Shortener : public ompl::geometric::PathSimplifier {
 public:
  Shortener(const ompl::base::SpaceInformationPtr& information, std::uint64_t seed)
      : ompl::geometric::PathSimplifier(information) {
    rng_.setLocalSeed(static_cast<std::uint_fast32_t>(seed % 0xFFFFFFFEU + 1));  // OMPL refuses 0
  }
};

/// RRT-Connect that tells how far its first tree has come.
class Connect : public ompl::geometric::RRTConnect {
 public:
  using ompl::geometric::RRTConnect::RRTConnect;

  /// Appends the path from the start to the state of its tree that is nearest to `end`.
  void append_nearest(const ompl::base::State* end, ompl::geometric::PathGeometric& path) const {
    std::vector<Motion*> all;
    tStart_->list(all);
    const Motion* nearest = nullptr;
    double least = 0.0;
    for (const Motion* motion : all)
      if (const double distance = si_->distance(motion->state, end); nearest == nullptr || distance < least) {
        nearest = motion;
        least = distance;
      }
    std::vector<const ompl::base::State*> states;
    for (; nearest != nullptr; nearest = nearest->parent) states.push_back(nearest->state);
    for (; !states.empty(); states.pop_back()) path.append(states.back());
  }
};

/// Suppresses OMPL's messages while an object exists, then restores the handler of the program.
class QuietOmpl {
 public:
  QuietOmpl() {
    const std::scoped_lock lock(mutex_);
    if (count_++ > 0) return;
    handler_ = ompl::msg::getOutputHandler();
    ompl::msg::noOutputHandler();
  }
  ~QuietOmpl() {
    const std::scoped_lock lock(mutex_);
    if (--count_ == 0) ompl::msg::useOutputHandler(handler_);
  }
  QuietOmpl(const QuietOmpl&) = delete;
  QuietOmpl& operator=(const QuietOmpl&) = delete;

 private:
  inline static std::mutex mutex_;
  inline static int count_ = 0;
  inline static ompl::msg::OutputHandler* handler_ = nullptr;
};

/// The state space of a problem, with the tests of its states and motions.
class MotionSpace {
 public:
  /// Both must outlive this object.
  MotionSpace(const MotionProblem& problem, const MotionSearch& search)
      : information_(
            std::make_shared<ompl::base::SpaceInformation>(std::make_shared<JointSpace>(problem, search.seed))),
        motions_(std::make_shared<MotionIsFree>(information_, problem, search.stop)) {
    information_->setStateValidityChecker(std::make_shared<StateIsFree>(information_, problem));
    information_->setMotionValidator(motions_);
    information_->setup();
  }
  const ompl::base::SpaceInformationPtr& information() const { return information_; }
  /// Number of motions that were tested.
  std::uint64_t tested() const {
    return std::uint64_t{motions_->getValidMotionCount()} + motions_->getInvalidMotionCount();
  }
  ompl::base::ScopedState<> state(std::span<const double> q) const {
    ompl::base::ScopedState<> made(information_);
    std::ranges::copy(q, JointSpace::values(made.get()).begin());
    return made;
  }
  static Waypoints waypoints(const ompl::geometric::PathGeometric& path) {
    Waypoints all;
    for (std::size_t k = 0; k < path.getStateCount(); ++k) {
      const std::span<const double> q = JointSpace::values(path.getState(static_cast<unsigned>(k)));
      all.emplace_back(q.begin(), q.end());
    }
    return all;
  }

 private:
  QuietOmpl quiet_;
  ompl::base::SpaceInformationPtr information_;
  std::shared_ptr<MotionIsFree> motions_;
};

}  // namespace detail

/// Plans from `from` to `to`, both free, by RRT-Connect (Kuffner & LaValle, ICRA 2000). The straight motion is tried
/// first. The motion is not shortened.
inline FoundMotion connect(const MotionProblem& problem, std::span<const double> from, std::span<const double> to,
                           const MotionSearch& search) {
  namespace ob = ompl::base;
  const detail::MotionSpace space(problem, search);
  const auto start = space.state(from), end = space.state(to);
  FoundMotion found;
  if (space.information()->checkMotion(start.get(), end.get())) {
    found.waypoints = {{from.begin(), from.end()}, {to.begin(), to.end()}};
    found.reached = true;
  } else {
    const auto definition = std::make_shared<ob::ProblemDefinition>(space.information());
    definition->setStartAndGoalStates(start, end, std::numeric_limits<double>::epsilon());
    detail::Connect planner(space.information());
    planner.setRange(search.range);
    planner.setProblemDefinition(definition);
    planner.setup();
    planner.solve(ob::PlannerTerminationCondition(
        [&] { return space.tested() >= search.most_motions || (search.stop && search.stop()); }));
    found.reached = definition->hasExactSolution();
    ompl::geometric::PathGeometric path(space.information());
    if (found.reached)
      path = static_cast<const ompl::geometric::PathGeometric&>(*definition->getSolutionPath());
    else
      planner.append_nearest(end.get(), path);
    found.waypoints = detail::MotionSpace::waypoints(path);
  }
  found.motions = space.tested();
  return found;
}

/// Shortens a motion by shortcuts until two rounds in a row gain less than 1 percent, and leaves out each waypoint
/// whose neighbours are joined by a free motion. Then replaces each motion by its steps (MotionProblem::steps). Adds
/// the motions that it tests to `found.motions`.
inline void shorten(const MotionProblem& problem, FoundMotion& found, const MotionSearch& search) {
  const detail::MotionSpace space(problem, search);
  const auto& information = space.information();
  ompl::geometric::PathGeometric path(information);
  for (const std::vector<double>& waypoint : found.waypoints) path.append(space.state(waypoint).get());

  detail::Shortener shortener(information, search.seed);
  constexpr unsigned shortcuts_per_round = 50;
  constexpr int most_idle_rounds = 2;
  constexpr double least_gain = 0.01;
  for (int idle = 0; idle < most_idle_rounds && path.getStateCount() > 2 && !(search.stop && search.stop());) {
    ompl::geometric::PathGeometric shorter(path);
    shortener.reduceVertices(shorter);
    shortener.shortcutPath(shorter, shortcuts_per_round, shortcuts_per_round);
    const bool gains = shorter.length() < (1.0 - least_gain) * path.length();
    // A shortcut cuts tested motions; their parts round to other states.
    bool is_free = true;
    for (std::size_t k = 1; k < shorter.getStateCount() && is_free; ++k)
      is_free = information->checkMotion(shorter.getState(static_cast<unsigned>(k - 1)),
                                         shorter.getState(static_cast<unsigned>(k)));
    idle = gains && is_free ? 0 : idle + 1;
    if (is_free) path = shorter;
  }

  std::vector<ompl::base::State*>& states = path.getStates();
  for (std::size_t k = 1; k + 1 < states.size() && !(search.stop && search.stop());) {
    if (!information->checkMotion(states[k - 1], states[k + 1])) {
      ++k;
      continue;
    }
    information->freeState(states[k]);
    states.erase(states.begin() + static_cast<std::ptrdiff_t>(k));
  }

  found.waypoints.clear();
  for (const std::vector<double>& q : detail::MotionSpace::waypoints(path)) {
    if (found.waypoints.empty())
      found.waypoints.push_back(q);
    else
      for (std::vector<double>& step : problem.steps(std::vector<double>(found.waypoints.back()), q))
        found.waypoints.push_back(std::move(step));
  }
  found.motions += space.tested();
}

/// Returns a motion that connect() finds, shortened. The result depends on the arguments alone, if stop never returns
/// true.
inline FoundMotion find_motion(const MotionProblem& problem, std::span<const double> from, std::span<const double> to,
                               const MotionSearch& search) {
  FoundMotion found = connect(problem, from, to, search);
  shorten(problem, found, search);
  if (!found.reached) found.remaining = problem.distance(found.waypoints.back(), to);
  return found;
}

}  // namespace hinge::planning
