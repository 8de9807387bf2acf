// SPDX-License-Identifier: BSD-3-Clause
// Plans motions of molecules: the straight path, RRT-Connect, or steps that follow coordinates.
#include "hinge/molecular/plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge_planning/find_motion.hpp"
#include "motion/clash_descent.hpp"
#include "motion/coordinate_descent.hpp"
#include "planning/conformation_problem.hpp"
#include "planning/follow.hpp"

namespace hinge::molecular {

namespace {

constexpr double range_share = 0.1;         // of the straight distance: the longest motion that is added to a tree
constexpr std::uint64_t few_motions = 100;  // of RRT-Connect before coordinates are followed
constexpr double near_rmsd = 1.0;           // angstrom, of the atoms that the selection moves

class Planner {
 public:
  Planner(const Checker& checker, const PlanOptions& options, const std::function<bool()>& stop)
      : checker_(checker),
        options_(options),
        stop_([this, &stop] {
          stopped_ = stopped_ || (stop && stop());
          return stopped_;
        }),
        problem_(checker, options.closures),
        all_(checker_, all_atoms(checker.molecule().structure().models.front()), options.closures, stop_) {}

  PlannedMotion run(const MotionEnd& from, const MotionEnd& to) {
    if (!is_replaceable(to) && is_replaceable(from)) {
      check_end(to.q, "end");
      PlannedMotion back = one_way(to, from);
      if (back.reached) {
        std::ranges::reverse(back.waypoints);
        std::swap(back.start_rmsd, back.end_rmsd);
        return back;
      }
    }
    check_end(from.q, "start");
    if (!is_replaceable(to)) check_end(to.q, "end");
    return one_way(from, to);
  }

 private:
  void check_end(std::span<const double> q, const char* which);
  bool is_replaceable(const MotionEnd& end) { return target_rmsd(end, end.q) > file_rounding; }
  double target_rmsd(const MotionEnd& end, std::span<const double> q) {
    return end.target.atoms.empty() ? 0.0 : superpose(all_.place(q), end.target).rmsd;
  }
  /// The largest distance of a replaced end from its target.
  double near(const MotionEnd& end);
  double distance(std::span<const double> a, std::span<const double> b) {
    all_.aim(all_.place(a));
    return all_.rmsd(b);
  }
  /// The start is free.
  PlannedMotion one_way(const MotionEnd& from, const MotionEnd& to);

  Checker checker_;
  const PlanOptions& options_;
  bool stopped_ = false;
  const std::function<bool()> stop_;
  ConformationProblem problem_;
  CoordinateDescent all_;  // with a target of all atoms
};

double Planner::near(const MotionEnd& end) {
  const auto moved = std::ranges::count_if(end.target.atoms,
                                           [&](std::uint32_t atom) { return checker_.group_of(atom) != GroupId{0}; });
  const double share = static_cast<double>(moved) / static_cast<double>(end.target.atoms.size());
  return std::max(near_rmsd * std::sqrt(share), target_rmsd(end, end.q));
}

void Planner::check_end(std::span<const double> q, const char* which) {
  if (checker_.check(q, Mode{}).collides) {
    const Structure& s = checker_.molecule().structure();
    const Hit hit = checker_.check(q, Mode{Mode::Kind::all}).pairs.front().hit;
    throw ConfigurationError(std::string("the ") + which +
                             " of the motion collides: " + label(s, static_cast<std::uint32_t>(index(hit.first))) +
                             " and " + label(s, static_cast<std::uint32_t>(index(hit.second))));
  }
  if (!problem_.is_closed(q))
    throw ConfigurationError(std::string("the ") + which + " of the motion: a closure is open by " +
                             number_text(problem_.residual(q)) + " angstrom, expected at most 1e-6");
}

PlannedMotion Planner::one_way(const MotionEnd& from, const MotionEnd& to) {
  const bool replaceable = is_replaceable(to);
  const bool end_is_free = !replaceable || (problem_.is_closed(to.q) && !checker_.check(to.q, Mode{}).collides);
  const auto connect = [&](const std::vector<double>& start, std::uint64_t most) {
    const planning::MotionProblem described = problem_.between(start, to.q);
    const double range = std::max(problem_.straight(), 1.0) * range_share;
    return planning::connect(described, start, to.q, {range, most, options_.seed, stop_});
  };
  planning::FoundMotion found{.waypoints = {from.q}};
  if (end_is_free) found = connect(from.q, std::min(few_motions, options_.most_motions / 2));
  if (!found.reached && !stopped_ && found.motions < options_.most_motions) {
    std::optional<CoordinateDescent> some;
    if (!to.target.atoms.empty()) some.emplace(checker_, to.target, options_.closures, stop_);
    const std::vector<Vec3> target = some ? to.target.positions : all_.place(to.q);
    Followed way = follow(problem_, some ? *some : all_, from.q, target, options_.most_motions - found.motions, stop_);
    found.waypoints = std::move(way.waypoints);
    found.motions += way.motions;
    found.reached = replaceable && target_rmsd(to, found.waypoints.back()) <= near(to);
  }
  if (!found.reached && end_is_free && found.motions < options_.most_motions) {
    planning::FoundMotion rest = connect(found.waypoints.back(), options_.most_motions - found.motions);
    found.waypoints.insert(found.waypoints.end(), rest.waypoints.begin() + 1, rest.waypoints.end());
    found.motions += rest.motions;
    found.reached = rest.reached;
  }
  planning::shorten(problem_.between(from.q, to.q), found, {.seed = options_.seed, .stop = stop_});

  PlannedMotion planned{.waypoints = std::move(found.waypoints), .reached = found.reached, .motions = found.motions};
  // Whole turns that a motion has made round its waypoints: prove exactly what is returned.
  for (std::size_t k = 1; k < planned.waypoints.size(); ++k)
    if (!problem_.is_certified(planned.waypoints[k - 1], planned.waypoints[k])) {
      planned.waypoints.resize(k);
      planned.reached = false;
    }
  planned.straight = distance(from.q, to.q);
  if (!planned.reached) {  // ends where it comes nearest
    std::vector<double> left;
    for (const std::vector<double>& q : planned.waypoints) left.push_back(distance(q, to.q));
    const auto least = std::ranges::min_element(left) - left.begin();
    planned.waypoints.resize(static_cast<std::size_t>(least) + 1);
    planned.remaining = left[static_cast<std::size_t>(least)];
  }
  for (std::size_t k = 1; k < planned.waypoints.size(); ++k) {
    const std::vector<double>&a = planned.waypoints[k - 1], &b = planned.waypoints[k];
    planned.length += distance(a, b);
    std::vector<double> middle(a.size());
    for (std::size_t c = 0; c < middle.size(); ++c) middle[c] = 0.5 * (a[c] + b[c]);
    planned.open = std::max(planned.open, problem_.residual(middle));
  }
  planned.start_rmsd = target_rmsd(from, planned.waypoints.front());
  planned.end_rmsd = target_rmsd(to, planned.waypoints.back());
  planned.stopped = stopped_;
  return planned;
}

}  // namespace

PlannedMotion plan(const Checker& checker, const MotionEnd& from, const MotionEnd& to, const PlanOptions& options,
                   const std::function<bool()>& stop) {
  if (checker.dof_count() == 0) throw ModelError("nothing is free, expected at least one torsion or placed part");
  if (options.most_motions == 0) throw ModelError("0 motions to test, expected at least one");
  for (const MotionEnd* end : {&from, &to}) {
    Checker(checker).check(end->q, Mode{});  // throws for bad values
    if (!end->target.atoms.empty()) check_target(checker, end->target);
  }
  return Planner(checker, options, stop).run(from, to);
}

}  // namespace hinge::molecular
