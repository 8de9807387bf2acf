// SPDX-License-Identifier: BSD-3-Clause
// Metric, draws and closed steps of motions between conformations.
#include "planning/conformation_problem.hpp"

#include <algorithm>
#include <numbers>

#include "motion/moved_atoms.hpp"

namespace hinge::molecular {

namespace {

constexpr double closed_step = 0.05;  // rad or angstrom
constexpr double part_range = 10.0;   // angstrom
// Share of its length by which a closed walk has to come nearer to its end.
constexpr double least_progress = 0.1;
constexpr double pi = std::numbers::pi;

}  // namespace

ConformationProblem::ConformationProblem(const Checker& checker, std::span<const std::size_t> closures)
    : checker_(checker), paths_(checker) {
  const auto atoms = static_cast<double>(checker.molecule().structure().atoms.size());
  const std::vector<double> reference(checker.dof_count(), 0.0);
  for (const MovedAtoms& moved : find_moved_atoms(checker_, reference))
    weights_.push_back(moved.lever / std::sqrt(atoms));
  turns_.assign(weights_.size(), false);
  const RigidGroups& groups = checker_.rigid_groups();
  for (std::size_t g = 1; g < groups.size(); ++g)
    turns_[groups[id<GroupId>(g)].dof] = groups[id<GroupId>(g)].joint.kind == JointKind::revolute;
  if (closures.empty()) return;
  const KinematicTree& tree = checker.molecule().model().tree();
  equations_.emplace(tree, checker.selection(), closures);
  solver_.emplace(tree, checker.selection(), closures);
}

planning::MotionProblem ConformationProblem::between(std::span<const double> from, std::span<const double> to) {
  from_.assign(from.begin(), from.end());
  to_ = end_of(from, to);
  straight_ = distance(from_, to_);
  using Values = std::span<const double>;
  planning::MotionProblem problem;
  problem.dof_count = from_.size();
  problem.largest_distance = largest_distance();
  problem.distance = [this](Values a, Values b) { return distance(a, b); };
  problem.draw = [this](SampleStream& stream, std::span<double> q) { draw(stream, q); };
  problem.is_free = [this](Values q) { return is_closed(q) && !checker_.check(q, Mode{}).collides; };
  problem.is_motion_free = [this](Values a, Values b) { return is_motion_free(a, b); };
  problem.go = [this](Values a, Values b, double share, std::span<double> q) { go(a, b, share, q); };
  problem.steps = [this](Values a, Values b) { return steps(a, b); };
  return problem;
}

double ConformationProblem::largest_distance() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < weights_.size(); ++k)
    sum += std::pow(weights_[k] * (turns_[k] ? pi : std::abs(to_[k] - from_[k]) + 2.0 * part_range), 2);
  return std::sqrt(sum);
}

bool ConformationProblem::close(std::vector<double>& q) {
  const std::vector<double> before(q);
  const bool closed = solver_->close(q);
  for (std::size_t k = 0; k < q.size(); ++k)
    if (turns_[k]) q[k] += 2.0 * pi * std::round((before[k] - q[k]) / (2.0 * pi));
  return closed;
}

/// Half of the draws are near the straight path, at a distance that is drawn from a wide range of scales; the others
/// are anywhere.
void ConformationProblem::draw(SampleStream& stream, std::span<double> q) {
  const bool is_near = stream.uniform() < 0.5;
  const double t = stream.uniform();
  const double away =
      std::max(straight_, 1.0) * std::exp2(-6.0 * stream.uniform()) / std::sqrt(static_cast<double>(q.size()));
  for (std::size_t k = 0; k < q.size(); ++k) {
    const double between = from_[k] + t * (to_[k] - from_[k]);
    if (is_near)
      q[k] = between + std::clamp(away / weights_[k], 0.0, pi) * stream.normal();
    else
      q[k] = (turns_[k] ? from_[k] : between) + (2.0 * stream.uniform() - 1.0) * (turns_[k] ? pi : part_range);
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
  if (!solver_ || share == 0.0) return;
  // An incomplete walk leaves q open, so it is not free. So does a walk that closing turns aside: a planner that takes
  // its next step from the nearest configuration would repeat it for ever.
  const std::size_t count = count_steps(from, to);
  const auto last = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(share * static_cast<double>(count))));
  std::vector<double> reached(from.begin(), from.end());
  const bool complete = walk(from, to, count, last, [&](const auto&, const std::vector<double>& next) {
    reached = next;
    return true;
  });
  const double before = distance(from, to);
  if (complete && distance(reached, to) <= (1.0 - least_progress * share) * before)
    std::ranges::copy(reached, q.begin());
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
  if (!is_closed(to)) return false;
  const std::size_t count = count_steps(from, to);
  return walk(from, to, count, count, [&](const std::vector<double>& here, const std::vector<double>& next) {
    return is_certified(here, next);
  });
}

}  // namespace hinge::molecular
