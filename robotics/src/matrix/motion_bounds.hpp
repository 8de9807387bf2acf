// SPDX-License-Identifier: BSD-3-Clause
// LinkPath: the joints that move one link against another, and their poses for a box of joint values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/detail/kinematics/swept_ball.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// An interval of values of one independent joint, rad or m.
struct Interval {
  double lower = 0.0;
  double upper = 0.0;
  double middle() const noexcept { return lower + (upper - lower) / 2; }
};

/// Both links in the frame of their lowest common rigid group, with all joints at the middles of their intervals.
struct PathState {
  Pose first;                                ///< pose of link A
  Pose second;                               ///< pose of link B
  std::vector<detail::AxisInterval> joints;  ///< from A to B; `joint` is an index into LinkPath::drivers()
};

/// The chain of joints between two links. Mimic joints are functions of their driver, so a box of joint values has one
/// interval per driver. A driver is an independent joint. `groups` must outlive the object.
class LinkPath {
 public:
  LinkPath(const Robot& robot, const RigidGroups& groups, LinkId a, LinkId b);

  /// Returns the independent joints that move the links against each other, as sorted indices.
  std::span<const std::size_t> drivers() const noexcept { return drivers_; }

  /// Computes the state for a box with one interval per driver.
  void place(std::span<const Interval> box, PathState& state) const;

  /// Returns a bound (m) on the sum of all rounding errors: of every quantity computed from here, and of everything the
  /// library computes for the two links in the world. reach_a, reach_b: BallTree::reach() of the links. Derived in
  /// docs/explanation/collision_matrix.md.
  double rounding(double reach_a, double reach_b) const noexcept;

 private:
  struct Step {
    GroupId group{};
    Robot::Drive drive;  // independent: index into drivers_
  };
  void find_sizes(const Robot& robot, LinkId link);
  static void place(const std::vector<Step>& steps, const RigidGroups& groups, std::span<const Interval> box,
                    std::vector<detail::AxisInterval>& joints, Pose& end);

  const RigidGroups* groups_;  // must outlive this object
  std::vector<std::size_t> drivers_;
  std::vector<Step> to_a_, to_b_;  // from the common group downwards
  Pose a_in_group_, b_in_group_;
  double length_ = 0.0;     // m, sum of the lengths of both chains from the root, fully extended
  double departure_ = 0.0;  // sum of the deviations of their origins from rigid transforms
  std::size_t joints_ = 0;  // number of joints of both chains, fixed ones included
};

}  // namespace hinge::robotics
