// SPDX-License-Identifier: BSD-3-Clause
// spheres_of: converts a robot whose collision shapes are all spheres to a model of spheres.
#pragma once

#include "hinge/core/api.hpp"
#include "hinge/model/model.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// Returns true if all collision shapes of the robot are spheres.
HINGE_API bool has_only_spheres(const Robot& robot);

/// Returns a model of spheres with the links and DOF of robot.model(), in m, spheres in the order of their links. If
/// the robot was made with Tessellation::Manner::rounded, it has one triangle per sphere in the same order, so that one
/// LinkPairFilter fits both models. robot.expand() gives a full configuration. Throws ModelError, naming the link, if a
/// shape is not a sphere.
HINGE_API Model<Sphere> spheres_of(const Robot& robot);

}  // namespace hinge::robotics
