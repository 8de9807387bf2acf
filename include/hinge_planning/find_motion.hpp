// SPDX-License-Identifier: BSD-3-Clause
// find_motion: finds a free motion between two configurations with OMPL's RRT-Connect, and shortens it.
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge_planning/joint_space.hpp"
#include "hinge_planning/motion_problem.hpp"
#include "hinge_planning/motion_space.hpp"

namespace hinge::planning {

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

/// Plans from `from` to `to` by RRT-Connect. The straight motion is tried first.
inline FoundMotion search_tree(const MotionProblem& problem, std::span<const double> from, std::span<const double> to,
                               const MotionSearch& search, Proof proof) {
  namespace ob = ompl::base;
  const MotionSpace space(problem, search, proof);
  const auto start = space.state(from), end = space.state(to);
  FoundMotion found;
  if (space.information()->checkMotion(start.get(), end.get())) {
    found.waypoints = {{from.begin(), from.end()}, {to.begin(), to.end()}};
    found.reached = true;
  } else {
    const auto definition = std::make_shared<ob::ProblemDefinition>(space.information());
    definition->setStartAndGoalStates(start, end, std::numeric_limits<double>::epsilon());
    Connect planner(space.information());
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
    found.waypoints = MotionSpace::waypoints(path);
  }
  found.motions = space.tested();
  return found;
}

/// Proves a motion that seems free. A part without a proof is replaced by a detour: at most `most` motions are tested
/// for it. After the search was stopped, there are no detours. Adds the motions that it tests to `found.motions`.
/// Returns false if a part is not proved; then the motion ends before it.
inline bool prove(const MotionProblem& problem, FoundMotion& found, const MotionSearch& search, std::uint64_t most) {
  Waypoints proved{found.waypoints.front()};
  bool whole = true;
  for (std::size_t k = 1; k < found.waypoints.size() && whole; ++k) {
    const std::vector<double>& next = found.waypoints[k];
    if (search.stop && search.stop()) {
      ++found.motions;
      whole = problem.is_motion_free(proved.back(), next);
      if (whole) proved.push_back(next);
    } else {
      MotionSearch near = search;
      near.most_motions = most;
      const FoundMotion part = search_tree(problem, proved.back(), next, near, Proof::needed);
      found.motions += part.motions;
      proved.insert(proved.end(), part.waypoints.begin() + 1, part.waypoints.end());
      whole = part.reached;
    }
  }
  found.reached = found.reached && whole;
  found.waypoints = std::move(proved);
  return whole;
}

}  // namespace detail

/// Plans from `from` to `to`, both free, by RRT-Connect (Kuffner & LaValle, ICRA 2000). The straight motion is tried
/// first. The motion is not shortened. If the problem has the test seems_free, the search uses it alone, and what it
/// finds is proved; only if that fails, a second search proves every motion at once.
inline FoundMotion connect(const MotionProblem& problem, std::span<const double> from, std::span<const double> to,
                           const MotionSearch& search) {
  constexpr std::uint64_t most_of_a_detour = 200;
  if (!problem.seems_free) return detail::search_tree(problem, from, to, search, detail::Proof::needed);
  FoundMotion found = detail::search_tree(problem, from, to, search, detail::Proof::later);
  const bool whole = detail::prove(problem, found, search, most_of_a_detour);
  if (whole || found.motions >= search.most_motions || (search.stop && search.stop())) return found;
  MotionSearch rest = search;
  rest.most_motions -= found.motions;
  FoundMotion proved = detail::search_tree(problem, from, to, rest, detail::Proof::needed);
  proved.motions += found.motions;
  return proved;
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
