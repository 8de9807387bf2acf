// SPDX-License-Identifier: BSD-3-Clause
// write_srdf: a collision matrix as an SRDF file that says of every disabled pair why, and of every other what was
// seen.
#pragma once

#include <iosfwd>

#include "hinge/robotics/collision_matrix.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// One disable_collisions element per disabled pair, in the order of the entries, with the reasons Adjacent, Always,
/// Default and Never that MoveIt's setup assistant uses. Never is written for proved pairs alone; a disabled pair that
/// was merely not seen has the reason NotSeen and a comment. All other pairs are listed in comments. read_srdf() of
/// what is written gives disabled_pairs(robot, matrix, unseen).
void write_srdf(const Robot& robot, const CollisionMatrix& matrix, std::ostream& out,
                UnseenPairs unseen = UnseenPairs::tested);

}  // namespace hinge::robotics
