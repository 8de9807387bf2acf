// SPDX-License-Identifier: BSD-3-Clause
// fill_closed_meshes: lets the inside of closed meshes collide.
#pragma once

#include <string>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/robotics/robot_description.hpp"

namespace hinge::robotics {

/// Makes every closed mesh of the robot solid, see MeshShape::solid, and all others not solid. Returns one sentence for
/// each mesh that is not closed. O(n log n) for n triangles.
HINGE_API std::vector<std::string> fill_closed_meshes(RobotDescription& robot);

}  // namespace hinge::robotics
