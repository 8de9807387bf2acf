// SPDX-License-Identifier: BSD-3-Clause
// AnyHierarchy: a hierarchy of triangles on links, with the engine chosen at run time.
#pragma once

#include <string>
#include <variant>

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

template <template <class, class, class> class EngineOf>
using RobotHierarchy = Hierarchy<Triangle, LinkPairFilter, LinkMargins, EngineOf>;

using AnyHierarchy = std::variant<RobotHierarchy<Simd>, RobotHierarchy<Lazy>, RobotHierarchy<Brute>>;

/// All DOF free. engine: "simd", "lazy" (the paper's) or "brute"; ModelError otherwise.
AnyHierarchy make_hierarchy(const std::string& engine, const Model<Triangle>& model, const LinkPairFilter& filter,
                            const LinkMargins& margins);

}  // namespace hinge::robotics
