// SPDX-License-Identifier: BSD-3-Clause
// Implements LinkPath: the joints between two links, their poses for a box of joint values, and a bound on rounding.
#include "matrix/motion_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "hinge/detail/bounds/round.hpp"
#include "hinge/detail/exact/error_free.hpp"

namespace hinge::robotics {

LinkPath::LinkPath(const Robot& robot, const RigidGroups& groups, LinkId a, LinkId b)
    : groups_(&groups), a_in_group_(groups.link_in_group(a)), b_in_group_(groups.link_in_group(b)) {
  // A parent's id is smaller, so the larger of the two ids is never the common group.
  GroupId at_a = groups.group_of(a), at_b = groups.group_of(b);
  const auto climb = [&](GroupId& at, std::vector<Step>& steps) {
    steps.push_back({at, robot.drives()[groups[at].dof]});
    drivers_.push_back(steps.back().drive.independent);
    at = groups[at].parent;
  };
  while (at_a != at_b) index(at_a) > index(at_b) ? climb(at_a, to_a_) : climb(at_b, to_b_);
  std::sort(drivers_.begin(), drivers_.end());
  drivers_.erase(std::unique(drivers_.begin(), drivers_.end()), drivers_.end());
  for (std::vector<Step>* steps : {&to_a_, &to_b_}) {
    std::reverse(steps->begin(), steps->end());
    for (Step& step : *steps)
      step.drive.independent = static_cast<std::size_t>(
          std::lower_bound(drivers_.begin(), drivers_.end(), step.drive.independent) - drivers_.begin());
  }
  find_sizes(robot, a);
  find_sizes(robot, b);
}

void LinkPath::find_sizes(const Robot& robot, LinkId link) {
  const KinematicTree& tree = robot.model().tree();
  for (; link != world; link = tree.parent(link)) {
    const Joint& joint = tree.joint(link);
    ++joints_;
    length_ += std::sqrt(squared_norm(joint.origin.translation));
    const Mat3& r = joint.origin.rotation;
    const Mat3 gram = product(r, Mat3(r.transpose()));
    double off = 0.0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) off = std::max(off, std::abs(gram(i, j) - (i == j ? 1.0 : 0.0)));
    departure_ += off;
    if (joint.kind != JointKind::prismatic) continue;
    const Robot::Drive& drive = robot.drives()[index(tree.dof_of(link))];
    for (const double q : {robot.lower()[drive.independent], robot.upper()[drive.independent]})
      length_ += std::abs(drive.multiplier * q) + std::abs(drive.offset);
  }
}

double LinkPath::rounding(double reach_a, double reach_b) const noexcept {
  constexpr double per_joint = 256.0;     // in half ulps of the longest length
  constexpr double at_the_links = 8.0;    // placing, sweeping and comparing, counted as so many joints
  constexpr double per_departure = 32.0;  // factor of the deviation of the joints' origins from rigid ones
  const double longest = length_ + reach_a + reach_b;
  return (per_joint * detail::exact::half_ulp * (static_cast<double>(joints_) + at_the_links) +
          per_departure * departure_) *
         longest;
}

void LinkPath::place(const std::vector<Step>& steps, const RigidGroups& groups, std::span<const Interval> box,
                     std::vector<detail::AxisInterval>& joints, Pose& end) {
  for (const Step& step : steps) {
    const Joint& joint = groups[step.group].joint;
    const Interval& interval = box[step.drive.independent];
    const double middle = interval.middle();
    const double half = detail::next_up(std::max(middle - interval.lower, interval.upper - middle));
    const double m = step.drive.multiplier, value = m * middle + step.drive.offset;
    end = end * (joint.origin * motion(joint, value));
    // m q + offset is rounded here and in later queries, twice each.
    const double largest = std::abs(m) * (std::abs(middle) + half) + std::abs(step.drive.offset);
    detail::AxisInterval axis;
    axis.kind = joint.kind;
    axis.axis = product(end.rotation, joint.axis);
    axis.point = end * joint.point;
    axis.joint = step.drive.independent;
    axis.set_half(interval.lower == interval.upper ? 0.0
                                                   : std::abs(m) * half + 8.0 * detail::exact::half_ulp * largest);
    joints.push_back(axis);
  }
}

void LinkPath::place(std::span<const Interval> box, PathState& state) const {
  state.joints.clear();
  state.first = state.second = Pose{};
  place(to_a_, *groups_, box, state.joints, state.first);
  std::reverse(state.joints.begin(), state.joints.end());
  place(to_b_, *groups_, box, state.joints, state.second);
  state.first = state.first * a_in_group_;
  state.second = state.second * b_in_group_;
}

}  // namespace hinge::robotics
