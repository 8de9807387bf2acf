// SPDX-License-Identifier: BSD-3-Clause
// Plans motions of a robot: gives find_motion() a metric, limits, random configurations and proofs.
#include "hinge/robotics/plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>

#include "checking/joint_levers.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge_planning/find_motion.hpp"

namespace hinge::robotics {

namespace {

// Of the largest distance: the longest motion that is added to a tree.
constexpr double range_share = 0.2;
// Of the longest motion: the distance between the configurations that are tested before a motion is proved.
constexpr double tested_share = 0.02;
// A motion is given up as not free if no shorter part of it than this share can be proved.
constexpr double smallest_planned_step = 0x1p-12;
constexpr double few_share = 0.5;  // of the draws that keep the joints that need not move

struct SearchStopped {};

class RobotMotions {
 public:
  RobotMotions(PathChecker& paths, std::span<const double> from, std::span<const double> to,
               const std::function<bool()>& stop)
      : robot_(paths.checker().robot()),
        paths_(paths),
        from_(from.begin(), from.end()),
        to_(to.begin(), to.end()),
        stop_(stop) {
    refuse_bad_end("start", from_);
    refuse_bad_end("end", to_);
    find_bounds();
    levers_ = joint_levers(robot_, lower_, upper_);
  }

  /// Returns the problem for the planner. It refers to this object.
  planning::MotionProblem described() {
    using Values = std::span<const double>;
    planning::MotionProblem problem;
    problem.dof_count = from_.size();
    problem.largest_distance = largest_distance();
    problem.distance = [this](Values a, Values b) { return distance(a, b); };
    problem.draw = [this](SampleStream& stream, std::span<double> q) { draw(stream, q); };
    problem.is_free = [this](Values q) { return paths_.is_free(q); };
    problem.seems_free = [this](Values a, Values b) { return seems_free(a, b); };
    problem.is_motion_free = [this](Values a, Values b) { return is_motion_free(a, b); };
    return problem;
  }
  double distance(std::span<const double> a, std::span<const double> b) const {
    double sum = 0.0;
    for (std::size_t j = 0; j < a.size(); ++j) sum += levers_[j] * (a[j] - b[j]) * levers_[j] * (a[j] - b[j]);
    return std::sqrt(sum);
  }
  double largest_distance() const { return distance(lower_, upper_); }
  /// Once true, always true.
  bool stops() {
    stopped_ = stopped_ || (stop_ && stop_());
    return stopped_;
  }

 private:
  void refuse_bad_end(const std::string& end, const std::vector<double>& q);
  void find_bounds();
  void draw(SampleStream& stream, std::span<double> q) const;
  bool seems_free(std::span<const double> a, std::span<const double> b);
  bool is_motion_free(std::span<const double> a, std::span<const double> b);

  const Robot& robot_;
  PathChecker& paths_;
  std::vector<double> from_, to_;
  std::vector<double> lower_, upper_;  // of the configurations that are drawn
  std::vector<double> levers_;
  const std::function<bool()>& stop_;
  bool stopped_ = false;
};

void RobotMotions::refuse_bad_end(const std::string& end, const std::vector<double>& q) {
  RobotPathAnswer answer;
  try {
    answer = paths_.certify(q, q);
  } catch (const ConfigurationError& error) {
    throw ConfigurationError("the " + end + ": " + error.what());
  }
  if (answer.is_free()) return;
  const auto named = [&](const LinkOrBody& part) {
    if (const auto* link = std::get_if<LinkId>(&part)) return "link '" + robot_.link_name(*link) + "'";
    return "body '" + paths_.environment()->name(std::get<BodyId>(part)) + "'";
  };
  std::string text = "the " + end;
  text +=
      answer.verdict == PathVerdict::colliding ? " collides" : " is so near to a collision that it is not proved free";
  if (answer.contact) text += ": " + named(answer.contact->first) + " and " + named(answer.contact->second);
  throw ConfigurationError(text);
}

/// Every second draw keeps the joints that have the same value at both ends: a detour seldom needs them.
void RobotMotions::draw(SampleStream& stream, std::span<double> q) const {
  const bool moves_all = stream.uniform() >= few_share;
  for (std::size_t j = 0; j < q.size(); ++j) {
    const double value = std::min(lower_[j] + stream.uniform() * (upper_[j] - lower_[j]), upper_[j]);
    q[j] = moves_all || from_[j] != to_[j] ? value : from_[j];
  }
}

bool RobotMotions::seems_free(std::span<const double> a, std::span<const double> b) {
  const double step = tested_share * range_share * largest_distance();
  const auto count = static_cast<std::size_t>(std::ceil(distance(a, b) / step));
  return planning::test_along(a, b, count, [this](std::span<const double> q) { return paths_.is_free(q); });
}

/// A proof that begins before the search is stopped ends with it.
bool RobotMotions::is_motion_free(std::span<const double> a, std::span<const double> b) {
  const bool stopped_before = stops();
  try {
    return paths_
        .certify(a, b, smallest_planned_step,
                 [this, stopped_before] {
                   if (stops() && !stopped_before) throw SearchStopped();
                 })
        .is_free();
  } catch (const SearchStopped&) {
    return false;
  }
}

void RobotMotions::find_bounds() {
  constexpr double turn = 6.283185307179586, sizes = 10.0;
  const double size = robot_size(robot_);
  for (std::size_t j = 0; j < from_.size(); ++j) {
    const auto [least, most] = std::minmax(from_[j], to_[j]);
    const JointType type = robot_.description().joints[robot_.independent_joints()[j]].type;
    if (type == JointType::continuous) {
      lower_.push_back(least - turn / 2);
      upper_.push_back(most + turn / 2);
      continue;
    }
    const double beyond = type == JointType::prismatic ? sizes * size : turn;
    lower_.push_back(std::min(least, std::max(robot_.lower()[j], least - beyond)));
    upper_.push_back(std::max(most, std::min(robot_.upper()[j], most + beyond)));
  }
}

}  // namespace

PlannedMotion plan(PathChecker& paths, std::span<const double> from, std::span<const double> to,
                   const PlanOptions& options, const std::function<bool()>& stop) {
  if (options.most_motions == 0) throw ModelError("0 motions, expected at least one");
  RobotMotions motions(paths, from, to, stop);
  planning::MotionSearch search;
  search.range = range_share * motions.largest_distance();
  search.most_motions = options.most_motions;
  search.seed = options.seed;
  search.stop = [&] { return motions.stops(); };
  planning::FoundMotion found = planning::find_motion(motions.described(), from, to, search);

  PlannedMotion planned;
  planned.waypoints = std::move(found.waypoints);
  planned.reached = found.reached;
  planned.straight = motions.distance(from, to);
  planned.remaining = found.remaining;
  planned.motions = found.motions;
  planned.stopped = motions.stops();
  for (std::size_t k = 0; k + 1 < planned.waypoints.size(); ++k)
    planned.length += motions.distance(planned.waypoints[k], planned.waypoints[k + 1]);
  return planned;
}

PlannedMotion plan(const RobotChecker& checker, const Environment* environment, std::span<const double> from,
                   std::span<const double> to, const PlanOptions& options, const std::function<bool()>& stop) {
  PathChecker paths = environment == nullptr ? PathChecker(checker) : PathChecker(checker, *environment);
  return plan(paths, from, to, options, stop);
}

}  // namespace hinge::robotics
