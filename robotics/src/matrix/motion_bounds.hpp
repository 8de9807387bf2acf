// SPDX-License-Identifier: BSD-3-Clause
// LinkPath: the joints that move one link against another, and where they are for a box of joint values.
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

/// Values of one independent joint, rad or m.
struct Interval {
  double lower = 0.0;
  double upper = 0.0;
  double middle() const noexcept { return lower + (upper - lower) / 2; }
};

/// Both links in the frame of their lowest common rigid group, all joints at the middles of their intervals.
struct PathState {
  Pose first;                                ///< of link A
  Pose second;                               ///< of link B
  std::vector<detail::AxisInterval> joints;  ///< from A to B; label: position in LinkPath::drivers()
};

/// Only joints between the two links count. Followers are functions of their driver: a box has one side per driver.
class LinkPath {
 public:
  LinkPath(const Robot& robot, const RigidGroups& groups, LinkId a, LinkId b);

  /// The independent joints that move the links against each other, sorted.
  std::span<const std::size_t> drivers() const noexcept { return drivers_; }

  /// box: an interval per driver.
  void place(std::span<const Interval> box, PathState& state) const;

  /// How far rounding can put anything that is computed from here, and anything the library computes for the two links
  /// in the world, from what the real numbers give, in sum; m. Reaches: see BallTree. Derived in
  /// docs/explanation/collision_matrix.md.
  double rounding(double reach_a, double reach_b) const noexcept;

 private:
  struct Step {
    GroupId group{};
    Robot::Drive drive;  // independent: position in drivers_
  };
  void find_sizes(const Robot& robot, LinkId link);
  static void place(const std::vector<Step>& steps, const RigidGroups& groups, std::span<const Interval> box,
                    std::vector<detail::AxisInterval>& joints, Pose& end);

  const RigidGroups* groups_;  // outlives this
  std::vector<std::size_t> drivers_;
  std::vector<Step> to_a_, to_b_;  // from the common group down
  Pose a_in_group_, b_in_group_;
  double length_ = 0.0;     // m, of the chains from the root to both links, stretched as far as they go
  double departure_ = 0.0;  // of their joints' origins from rigid placements, summed
  std::size_t joints_ = 0;  // of both chains, fixed ones included
};

}  // namespace hinge::robotics
