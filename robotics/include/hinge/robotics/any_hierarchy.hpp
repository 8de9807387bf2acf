// SPDX-License-Identifier: BSD-3-Clause
// AnyHierarchy: a hierarchy of a robot's triangles whose engine is chosen at run time.
#pragma once

#include <string>
#include <variant>

#include "hinge/core/api.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/model/model.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/tested_pairs.hpp"

namespace hinge::robotics {

/// A hierarchy over a robot's triangles: pairs admitted by link, thresholds from LinkMargins.
template <template <class, class, class> class EngineOf>
using RobotHierarchy = Hierarchy<Triangle, LinkPairFilter, LinkMargins, EngineOf>;

/// One of the three engines.
using AnyHierarchy = std::variant<RobotHierarchy<Simd>, RobotHierarchy<Lazy>, RobotHierarchy<Brute>>;

/// Returns a hierarchy of `model` with every DOF free. engine: "simd", "lazy" (the paper's engine) or "brute". Throws
/// ModelError for any other name, or if filter or margins were made for another number of triangles.
HINGE_API AnyHierarchy make_hierarchy(const std::string& engine, const Model<Triangle>& model,
                                      const LinkPairFilter& filter, const LinkMargins& margins);

}  // namespace hinge::robotics
