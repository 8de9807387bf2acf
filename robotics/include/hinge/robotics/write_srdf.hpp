// SPDX-License-Identifier: BSD-3-Clause
// write_srdf and merge_srdf: write a collision matrix as an SRDF file, or add it to an existing one.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "hinge/core/api.hpp"
#include "hinge/robotics/collision_matrix.hpp"
#include "hinge/robotics/read_srdf.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// Writes an SRDF file with one disable_collisions element per disabled pair, in the order of the entries. The reasons
/// Adjacent, Always, Default and Never are those of MoveIt's setup assistant; Never is used only for proved pairs. A
/// disabled pair that was only not seen has the reason NotSeen and a comment. All other pairs are listed in comments.
/// read_srdf() of the result gives disabled_pairs(robot, matrix, unseen).
HINGE_API void write_srdf(const Robot& robot, const CollisionMatrix& matrix, std::ostream& out,
                          UnseenPairs unseen = UnseenPairs::tested);

/// Copies the SRDF file `path` byte for byte and inserts the matrix before its last closing tag. Inserts an element for
/// each disabled pair that the file neither disables nor enables. For a pair that the file disables, a comment is
/// inserted only if it was seen to collide. For a pair that the file enables, a comment names the reason to disable it,
/// if there is one. All other pairs get a comment. `srdf` is the result of read_srdf() for the file. Throws LoadError
/// if the file cannot be read.
HINGE_API void merge_srdf(const std::filesystem::path& path, const Srdf& srdf, const Robot& robot,
                          const CollisionMatrix& matrix, std::ostream& out, UnseenPairs unseen = UnseenPairs::tested);
/// The same with the contents of the SRDF file.
HINGE_API void merge_srdf_text(const std::string& xml, const Srdf& srdf, const Robot& robot,
                               const CollisionMatrix& matrix, std::ostream& out,
                               UnseenPairs unseen = UnseenPairs::tested);

}  // namespace hinge::robotics
