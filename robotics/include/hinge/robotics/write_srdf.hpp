// SPDX-License-Identifier: BSD-3-Clause
// write_srdf: a collision matrix as an SRDF file that says of every disabled pair why, and of every other what was
// seen. merge_srdf: the same put into an SRDF file that there is.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "hinge/robotics/collision_matrix.hpp"
#include "hinge/robotics/read_srdf.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// One disable_collisions element per disabled pair, in the order of the entries, with the reasons Adjacent, Always,
/// Default and Never that MoveIt's setup assistant uses. Never is written for proved pairs alone; a disabled pair that
/// was merely not seen has the reason NotSeen and a comment. All other pairs are listed in comments. read_srdf() of
/// what is written gives disabled_pairs(robot, matrix, unseen).
void write_srdf(const Robot& robot, const CollisionMatrix& matrix, std::ostream& out,
                UnseenPairs unseen = UnseenPairs::tested);

/// The file as it is, every byte of it, with that put in before its end: elements for disabled pairs that the file
/// neither disables nor enables, comments for all others but those it disables. Of a pair that the file disables a
/// comment says when it was seen to collide; of one that it enables, what would have disabled it. `srdf`: what
/// read_srdf() makes of the file. LoadError: it cannot be read.
void merge_srdf(const std::filesystem::path& path, const Srdf& srdf, const Robot& robot, const CollisionMatrix& matrix,
                std::ostream& out, UnseenPairs unseen = UnseenPairs::tested);

}  // namespace hinge::robotics
