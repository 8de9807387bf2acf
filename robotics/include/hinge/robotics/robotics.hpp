// SPDX-License-Identifier: BSD-3-Clause
// Includes every public header of hinge::robotics.
#pragma once

#include "hinge/robotics/any_hierarchy.hpp"
#include "hinge/robotics/clearance.hpp"
#include "hinge/robotics/collision_matrix.hpp"
#include "hinge/robotics/contact.hpp"
#include "hinge/robotics/containment.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge/robotics/plan.hpp"
#include "hinge/robotics/random_configuration.hpp"
#include "hinge/robotics/read_mesh.hpp"
#include "hinge/robotics/read_points.hpp"
#include "hinge/robotics/read_srdf.hpp"
#include "hinge/robotics/read_urdf.hpp"
#include "hinge/robotics/relax.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/robot_description.hpp"
#include "hinge/robotics/rpy.hpp"
#include "hinge/robotics/shape.hpp"
#include "hinge/robotics/solid_meshes.hpp"
#include "hinge/robotics/sphere_model.hpp"
#include "hinge/robotics/tessellate.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "hinge/robotics/tiers.hpp"
#include "hinge/robotics/write_srdf.hpp"

/// Robots of triangle meshes: URDF and SRDF, environments, checks of configurations and paths. Lengths in metres,
/// angles in radians.
namespace hinge::robotics {}
