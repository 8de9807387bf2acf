// SPDX-License-Identifier: BSD-3-Clause
// Implements spheres_of: the description's spheres on the robot's own tree.
#include "hinge/robotics/sphere_model.hpp"

#include <cstddef>
#include <map>
#include <string_view>
#include <variant>

#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/robotics/shape.hpp"

namespace hinge::robotics {

bool has_only_spheres(const Robot& robot) {
  for (const LinkDescription& link : robot.description().links)
    for (const PlacedShape& placed : link.geometry)
      if (!std::holds_alternative<SphereShape>(placed.shape)) return false;
  return true;
}

Model<Sphere> spheres_of(const Robot& robot) {
  std::map<std::string_view, const LinkDescription*> descriptions;
  for (const LinkDescription& link : robot.description().links) descriptions[link.name] = &link;
  const KinematicTree& tree = robot.model().tree();
  ModelBuilder<Sphere> builder;
  for (std::size_t l = 1; l < robot.link_count(); ++l) {
    const LinkId link = id<LinkId>(l);
    builder.add_link(tree.parent(link), tree.joint(link));
    for (const PlacedShape& placed : descriptions.at(robot.link_name(link))->geometry) {
      const auto* sphere = std::get_if<SphereShape>(&placed.shape);
      if (sphere == nullptr)
        throw ModelError("link '" + robot.link_name(link) + "' of robot '" + robot.name() +
                         "' has a shape that is not a sphere, expected only spheres");
      builder.add_primitive(link, {placed.origin.translation, sphere->radius});
    }
  }
  return builder.finish();
}

}  // namespace hinge::robotics
