// SPDX-License-Identifier: BSD-3-Clause
// Plans motions of molecules with RRT-Connect.
#include "hinge/molecular/plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "hinge/core/error.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/kinematics/closure_solver.hpp"
#include "hinge/molecular/path_checker.hpp"
#include "hinge_planning/find_motion.hpp"
#include "mechanism/moved_atoms.hpp"

namespace hinge::molecular {

namespace {

constexpr double closed_step = 0.05;       // rad or angstrom
constexpr double closed_tolerance = 1e-6;  // angstrom
constexpr double range_share = 0.1;        // of the straight distance: the longest motion that is added to a tree
constexpr double part_range = 10.0;        // angstrom
constexpr double pi = std::numbers::pi;

class ConformationProblem {
 public:
  ConformationProblem(const Checker& checker, std::span<const double> from, std::span<const double> to,
                      std::span<const std::size_t> closures)
      : checker_(checker), paths_(checker), from_(from.begin(), from.end()), to_(to.begin(), to.end()) {
    const auto atoms = static_cast<double>(checker.molecule().structure().atoms.size());
    const std::vector<double> reference(checker.dof_count(), 0.0);
    for (const MovedAtoms& moved : find_moved_atoms(checker_, reference))
      weights_.push_back(moved.lever / std::sqrt(atoms));
    turns_.assign(from_.size(), false);
    const RigidGroups& groups = checker_.rigid_groups();
    for (std::size_t g = 1; g < groups.size(); ++g)
      turns_[groups[id<GroupId>(g)].dof] = groups[id<GroupId>(g)].joint.kind == JointKind::revolute;
    straight_ = distance(from_, to_);
    if (closures.empty()) return;
    const KinematicTree& tree = checker.molecule().model().tree();
    equations_.emplace(tree, checker.selection(), closures);
    solver_.emplace(tree, checker.selection(), closures);
  }

  /// Returns the problem for the planner. It refers to this object.
  planning::MotionProblem described() {
    using Values = std::span<const double>;
    planning::MotionProblem problem;
    problem.dof_count = from_.size();
    problem.largest_distance = largest_distance();
    problem.distance = [this](Values a, Values b) { return distance(a, b); };
    problem.draw = [this](SampleStream& stream, std::span<double> q) { draw(stream, q); };
    problem.is_free = [this](Values q) { return is_closed(q) && !checker_.check(q, Mode{}).collides; };
    problem.is_motion_free = [this](Values from, Values to) { return is_motion_free(from, to); };
    problem.go = [this](Values from, Values to, double share, std::span<double> q) { go(from, to, share, q); };
    problem.steps = [this](Values from, Values to) { return steps(from, to); };
    return problem;
  }
  double distance(std::span<const double> a, std::span<const double> b) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += std::pow(weights_[k] * change(k, a, b), 2);
    return std::sqrt(sum);
  }
  double straight() const noexcept { return straight_; }
  /// Returns the largest residual at the configuration, angstrom; 0 without closures.
  double residual(std::span<const double> q) {
    if (!equations_) return 0.0;
    equations_->set(q);
    return equations_->worst();
  }
  /// Returns the configuration of `to` that the motion from `from` ends at: no angle changes by more than half a turn.
  std::vector<double> end_of(std::span<const double> from, std::span<const double> to) const {
    std::vector<double> end(from.begin(), from.end());
    for (std::size_t k = 0; k < end.size(); ++k) end[k] += change(k, from, to);
    return end;
  }
  bool is_certified(std::span<const double> from, std::span<const double> to) {
    return paths_.certify(from, to).is_free();
  }
  bool is_closed(std::span<const double> q) { return residual(q) <= closed_tolerance; }

 private:
  double largest_distance() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < weights_.size(); ++k)
      sum += std::pow(weights_[k] * (turns_[k] ? pi : std::abs(to_[k] - from_[k]) + 2.0 * part_range), 2);
    return std::sqrt(sum);
  }
  void draw(SampleStream& stream, std::span<double> q);
  void go(std::span<const double> from, std::span<const double> to, double share, std::span<double> q);
  std::vector<std::vector<double>> steps(std::span<const double> from, std::span<const double> to);
  bool is_motion_free(std::span<const double> from, std::span<const double> to);
  /// The change of a value from a to b; an angle takes the shorter way round.
  double change(std::size_t k, std::span<const double> a, std::span<const double> b) const {
    return turns_[k] ? std::remainder(b[k] - a[k], 2.0 * pi) : b[k] - a[k];
  }
  /// Closes the cycles of q; angles stay within half a turn of where they were.
  bool close(std::vector<double>& q) {
    const std::vector<double> before(q);
    const bool closed = solver_->close(q);
    for (std::size_t k = 0; k < q.size(); ++k)
      if (turns_[k]) q[k] += 2.0 * pi * std::round((before[k] - q[k]) / (2.0 * pi));
    return closed;
  }
  /// Walks from `from` towards `to` in `count` closed steps and calls step(q) for the first `last` of them. Returns
  /// false if a step does not close or jumps.
  template <class Step>
  bool walk(std::span<const double> from, std::span<const double> to, std::size_t count, std::size_t last,
            const Step& step);
  std::size_t count_steps(std::span<const double> from, std::span<const double> to) const;

  Checker checker_;
  PathChecker paths_;
  std::vector<double> from_, to_;
  std::vector<double> weights_;  // angstrom per rad, or 1
  std::vector<bool> turns_;
  double straight_ = 0.0;
  std::optional<ClosureEquations> equations_;
  std::optional<ClosureSolver> solver_;
};

/// Half of the draws are near the straight path, at a distance that is drawn from a wide range of scales.
void ConformationProblem::draw(SampleStream& stream, std::span<double> q) {
  if (stream.uniform() < 0.5) {
    const double t = stream.uniform();
    const double away =
        std::max(straight_, 1.0) * std::exp2(-6.0 * stream.uniform()) / std::sqrt(static_cast<double>(q.size()));
    for (std::size_t k = 0; k < q.size(); ++k) {
      const double noise = std::clamp(away / weights_[k], 0.0, pi) * stream.normal();
      q[k] = from_[k] + t * (to_[k] - from_[k]) + noise;
    }
  } else {
    const double t = stream.uniform();
    for (std::size_t k = 0; k < q.size(); ++k) {
      const double middle = turns_[k] ? from_[k] : from_[k] + t * (to_[k] - from_[k]);
      q[k] = middle + (2.0 * stream.uniform() - 1.0) * (turns_[k] ? pi : part_range);
    }
  }
}

std::size_t ConformationProblem::count_steps(std::span<const double> from, std::span<const double> to) const {
  double largest = 0.0;
  for (std::size_t k = 0; k < from.size(); ++k) largest = std::max(largest, std::abs(change(k, from, to)));
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(largest / closed_step)));
}

template <class Step>
bool ConformationProblem::walk(std::span<const double> from, std::span<const double> to, std::size_t count,
                               std::size_t last, const Step& step) {
  std::vector<double> here(from.begin(), from.end()), next(here.size());
  const std::vector<double> end = end_of(from, to);
  for (std::size_t s = 0; s < last; ++s) {
    const double share = 1.0 / static_cast<double>(count - s);
    bool jumps = false;
    if (s + 1 == count) {
      next = end;
    } else {
      for (std::size_t k = 0; k < next.size(); ++k) next[k] = here[k] + share * (end[k] - here[k]);
      if (!close(next)) return false;
    }
    for (std::size_t k = 0; k < next.size(); ++k) jumps = jumps || std::abs(next[k] - here[k]) > 2.0 * closed_step;
    if (jumps || !step(here, next)) return false;
    std::swap(here, next);
  }
  return true;
}

void ConformationProblem::go(std::span<const double> from, std::span<const double> to, double share,
                             std::span<double> q) {
  const std::vector<double> end = end_of(from, to);
  planning::go_straight(from, end, share, q);
  if (!solver_) return;
  // An incomplete walk leaves q open, so it is not free.
  const std::size_t count = count_steps(from, to);
  const auto last = static_cast<std::size_t>(std::lround(share * static_cast<double>(count)));
  std::vector<double> reached(from.begin(), from.end());
  const bool complete = walk(from, to, count, last, [&](const auto&, const std::vector<double>& next) {
    reached = next;
    return true;
  });
  if (complete) std::ranges::copy(reached, q.begin());
}

std::vector<std::vector<double>> ConformationProblem::steps(std::span<const double> from, std::span<const double> to) {
  if (!solver_) return {end_of(from, to)};
  std::vector<std::vector<double>> all;
  const std::size_t count = count_steps(from, to);
  walk(from, to, count, count, [&](const auto&, const std::vector<double>& next) {
    all.push_back(next);
    return true;
  });
  return all;
}

bool ConformationProblem::is_motion_free(std::span<const double> from, std::span<const double> to) {
  if (!solver_) return is_certified(from, end_of(from, to));
  const std::size_t count = count_steps(from, to);
  return walk(from, to, count, count, [&](const std::vector<double>& here, const std::vector<double>& next) {
    return is_certified(here, next);
  });
}

void check_end(const Checker& checker, ConformationProblem& problem, std::span<const double> q, const char* which) {
  Checker fresh = checker;
  const Verdict verdict = fresh.check(q, Mode{});
  if (verdict.collides) {
    const Structure& s = checker.molecule().structure();
    const Hit hit = fresh.check(q, Mode{Mode::Kind::all}).pairs.front().hit;
    throw ConfigurationError(std::string("the ") + which +
                             " of the motion collides: " + label(s, static_cast<std::uint32_t>(index(hit.first))) +
                             " and " + label(s, static_cast<std::uint32_t>(index(hit.second))));
  }
  if (!problem.is_closed(q))
    throw ConfigurationError(std::string("the ") + which + " of the motion: a closure is open by " +
                             number_text(problem.residual(q)) + " angstrom, expected at most 1e-6");
}

}  // namespace

PlannedMotion plan(const Checker& checker, std::span<const double> from, std::span<const double> to,
                   const PlanOptions& options, const std::function<bool()>& stop) {
  if (checker.dof_count() == 0) throw ModelError("nothing is free, expected at least one torsion or placed part");
  if (options.most_motions == 0) throw ModelError("0 motions to test, expected at least one");
  for (const std::span<const double> q : {from, to}) Checker(checker).check(q, Mode{});  // throws for bad values
  ConformationProblem problem(checker, from, to, options.closures);
  check_end(checker, problem, from, "start");
  check_end(checker, problem, to, "end");

  PlannedMotion planned;
  planned.straight = problem.straight();
  const double range = std::max(problem.straight(), 1.0) * range_share;
  planning::FoundMotion found =
      planning::find_motion(problem.described(), from, to, {range, options.most_motions, options.seed, [&] {
                                                              planned.stopped = planned.stopped || (stop && stop());
                                                              return planned.stopped;
                                                            }});
  planned.waypoints = std::move(found.waypoints);
  planned.reached = found.reached;
  planned.motions = found.motions;
  // Whole turns that a motion has made round its waypoints: prove exactly what is returned.
  for (std::size_t k = 1; k < planned.waypoints.size(); ++k)
    if (!problem.is_certified(planned.waypoints[k - 1], planned.waypoints[k])) {
      planned.waypoints.resize(k);
      planned.reached = false;
    }
  if (!planned.reached) planned.remaining = problem.distance(planned.waypoints.back(), to);
  for (std::size_t k = 1; k < planned.waypoints.size(); ++k) {
    const std::vector<double>&a = planned.waypoints[k - 1], &b = planned.waypoints[k];
    planned.length += problem.distance(a, b);
    std::vector<double> middle(a.size());
    for (std::size_t c = 0; c < middle.size(); ++c) middle[c] = 0.5 * (a[c] + b[c]);
    planned.open = std::max(planned.open, problem.residual(middle));
  }
  return planned;
}

}  // namespace hinge::molecular
