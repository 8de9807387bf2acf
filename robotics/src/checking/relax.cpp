// SPDX-License-Identifier: BSD-3-Clause
// Searches for the nearest free configuration of a robot.
#include "hinge/robotics/relax.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <set>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/kinematics/kinematic_tree.hpp"

namespace hinge::robotics {

namespace {

constexpr double first_radius = 0.01, radius_growth = 1.25;  // rad or m
constexpr int draws_per_radius = 64;
constexpr int halvings = 16;         // of a line
constexpr int random_steps = 200;    // between two attempts to go back
constexpr double least_gain = 0.01;  // of the distance, by one round of going back

class RobotRelaxer {
 public:
  RobotRelaxer(RobotChecker& checker, Environment* environment, std::span<const double> start,
               const RelaxOptions& options, const std::function<bool()>& stop)
      : checker_(checker),
        environment_(environment),
        start_(start.begin(), start.end()),
        options_(options),
        stop_(stop),
        stream_(options.seed, 0) {
    if (options.most_tries == 0) throw ModelError("0 tries, expected at least one");
  }

  Relaxation run() {
    if (is_free(start_)) {
      result_.q = start_;
      result_.is_free = true;
      return std::move(result_);
    }
    find_moving_joints();
    result_.q = start_;
    if (!movers_.empty() && find_any()) {
      go_back();
      result_.is_free = true;
      result_.distance = distance(result_.q);
    }
    return std::move(result_);
  }

 private:
  bool has_time() {
    result_.stopped = result_.stopped || (stop_ && stop_());
    return !result_.stopped && result_.tries < options_.most_tries;
  }
  bool is_free(std::span<const double> q) {
    ++result_.tries;
    checker_.update(q);
    return !checker_.collides() && (environment_ == nullptr || !checker_.collides(*environment_));
  }
  double distance(std::span<const double> q) const {
    double sum = 0.0;
    for (std::size_t j = 0; j < q.size(); ++j) sum += (q[j] - start_[j]) * (q[j] - start_[j]);
    return std::sqrt(sum);
  }
  double within_limits(std::size_t j, double value) const {
    return std::clamp(value, std::min(checker_.robot().lower()[j], start_[j]),
                      std::max(checker_.robot().upper()[j], start_[j]));
  }
  /// Makes q the result if it is free.
  bool take(std::vector<double> q) {
    if (!is_free(q)) return false;
    result_.q = std::move(q);
    return true;
  }

  void find_moving_joints();
  bool find_any();
  void go_back();
  void go_back_by_joints();
  void go_back_straight();

  RobotChecker& checker_;
  Environment* environment_;
  std::vector<double> start_;
  RelaxOptions options_;
  const std::function<bool()>& stop_;
  SampleStream stream_;
  std::vector<std::size_t> movers_;  // independent joints that move a colliding pair
  Relaxation result_;
};

/// The checker is at the start.
void RobotRelaxer::find_moving_joints() {
  const Robot& robot = checker_.robot();
  const KinematicTree& tree = robot.model().tree();
  std::set<std::size_t> joints;
  // Joints between the two links, or between a link and the world.
  const auto add = [&](LinkId a, LinkId b) {
    while (a != b) {
      LinkId& later = a < b ? b : a;  // parents have smaller indices
      if (tree.joint(later).has_dof()) joints.insert(robot.drives()[index(tree.dof_of(later))].independent);
      later = tree.parent(later);
    }
  };
  for (const LinkContact& contact : checker_.colliding_links()) add(contact.link1, contact.link2);
  if (environment_ != nullptr)
    for (const BodyContact& contact : checker_.collisions(*environment_)) {
      add(contact.link, LinkId{0});
      // The body may be held by this robot; if by another one, more joints than needed are drawn.
      const LinkId holder = environment_->attached_to(contact.body).value_or(LinkId{0});
      if (index(holder) < robot.link_count()) add(holder, LinkId{0});
    }
  movers_.assign(joints.begin(), joints.end());
}

/// Draws in growing balls until a ball holds free configurations; takes the nearest of them.
bool RobotRelaxer::find_any() {
  const Robot& robot = checker_.robot();
  double largest = 0.0;
  for (const std::size_t j : movers_)
    largest += std::pow(std::max({robot.upper()[j] - start_[j], start_[j] - robot.lower()[j], first_radius}), 2);
  largest = std::sqrt(largest);
  bool found = false;
  for (double radius = first_radius; !found && has_time(); radius = std::min(radius * radius_growth, largest))
    for (int k = 0; k < draws_per_radius && has_time(); ++k) {
      std::vector<double> q(start_);
      // Every second draw moves a single joint: often one is enough.
      const std::size_t one =
          movers_[static_cast<std::size_t>(stream_.uniform() * static_cast<double>(movers_.size()))];
      for (const std::size_t j : movers_)
        if (k % 2 == 0 || j == one)
          q[j] = within_limits(j, q[j] + radius * stream_.normal() / (k % 2 == 0 ? std::sqrt(movers_.size()) : 1.0));
      if (found && distance(q) >= distance(result_.q)) continue;
      found = take(std::move(q)) || found;
    }
  return found;
}

void RobotRelaxer::go_back() {
  for (double before = HUGE_VAL; has_time() && distance(result_.q) < (1.0 - least_gain) * before;) {
    before = distance(result_.q);
    go_back_by_joints();
    go_back_straight();
    for (int k = 0; k < random_steps && has_time(); ++k) {
      // Around the result, and around the start: a nearer free place may lie on another side.
      std::vector<double> q(k % 2 == 0 ? result_.q : start_);
      const double size = distance(result_.q) * stream_.uniform() / std::sqrt(movers_.size());
      for (const std::size_t j : movers_) q[j] = within_limits(j, q[j] + size * stream_.normal());
      if (distance(q) < distance(result_.q)) take(std::move(q));
    }
  }
}

/// Moves each joint as near to its start as halving finds, the largest changes first.
void RobotRelaxer::go_back_by_joints() {
  std::vector<std::size_t> order(movers_);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return std::abs(result_.q[a] - start_[a]) > std::abs(result_.q[b] - start_[b]);
  });
  for (const std::size_t j : order) {
    std::vector<double> q(result_.q);
    q[j] = start_[j];
    if (q == result_.q || !has_time() || take(q)) continue;
    double bad = start_[j];
    for (int k = 0; k < halvings && has_time(); ++k) {
      q[j] = bad + (result_.q[j] - bad) / 2;
      if (!take(q)) bad = q[j];
    }
  }
}

/// Moves all joints towards the start by halving.
void RobotRelaxer::go_back_straight() {
  std::vector<double> bad(start_), middle(start_.size());
  for (int k = 0; k < halvings && has_time(); ++k) {
    for (std::size_t j = 0; j < middle.size(); ++j) middle[j] = bad[j] + (result_.q[j] - bad[j]) / 2;
    if (!take(middle)) bad = middle;
  }
}

}  // namespace

Relaxation relax(RobotChecker& checker, Environment* environment, std::span<const double> start,
                 const RelaxOptions& options, const std::function<bool()>& stop) {
  return RobotRelaxer(checker, environment, start, options, stop).run();
}

}  // namespace hinge::robotics
