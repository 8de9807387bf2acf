// SPDX-License-Identifier: BSD-3-Clause
// free_in_world: a robot's model with a root link that can be placed anywhere.
#pragma once

#include <cstddef>

#include "hinge/core/id.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/model/model.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::robotics {

/// Returns a model with the same links and triangles, whose root link is free in the world.
inline Model<Triangle> free_in_world(const Model<Triangle>& model) {
  ModelBuilder<Triangle> builder;
  for (std::size_t l = 1; l < model.tree().link_count(); ++l) {
    const LinkId parent = model.tree().parent(id<LinkId>(l));
    const Joint& joint = model.tree().joint(id<LinkId>(l));
    // Poses are set from the robot's own tree, so the type of this joint does not matter.
    builder.add_link(parent, parent == world ? Joint(Prismatic{Vec3::UnitX(), joint.origin, "base"}) : joint);
  }
  for (std::size_t i = 0; i < model.size(); ++i) builder.add_primitive(model.links()[i], model.primitives()[i]);
  return builder.finish();
}

}  // namespace hinge::robotics
