// SPDX-License-Identifier: BSD-3-Clause
// spheres_of: a robot whose collision geometry is spheres alone, as a model of spheres.
#pragma once

#include "hinge/model/model.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// Links and DOF as in robot.model(), metres; spheres in the order of their links. Made with Tessellation::rounded, the
/// robot has one triangle for each sphere, in the same order: LinkPairFilter fits both. A full configuration is
/// robot.expand() of one. ModelError, naming the link: a shape that is no sphere.
Model<Sphere> spheres_of(const Robot& robot);

}  // namespace hinge::robotics
