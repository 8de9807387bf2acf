// SPDX-License-Identifier: BSD-3-Clause
// Implements fill_closed_meshes.
#include "hinge/robotics/solid_meshes.hpp"

#include <variant>

#include "hinge/robotics/containment.hpp"
#include "hinge/robotics/tessellate.hpp"

namespace hinge::robotics {

std::vector<std::string> fill_closed_meshes(RobotDescription& robot) {
  std::vector<std::string> notes;
  for (LinkDescription& link : robot.links)
    for (PlacedShape& placed : link.geometry) {
      auto* mesh = std::get_if<MeshShape>(&placed.shape);
      if (mesh == nullptr) continue;
      const auto open = open_edge(tessellate(*mesh).triangles);
      mesh->solid = !open;
      if (open)
        notes.push_back("link '" + link.name +
                        "' has an open mesh, so containment in it is not tested: " + open->text());
    }
  return notes;
}

}  // namespace hinge::robotics
