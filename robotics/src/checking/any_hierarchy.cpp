// SPDX-License-Identifier: BSD-3-Clause
// Makes the hierarchy for an engine given by name.
#include "hinge/robotics/any_hierarchy.hpp"

#include "hinge/core/error.hpp"

namespace hinge::robotics {

AnyHierarchy make_hierarchy(const std::string& engine, const Model<Triangle>& model, const LinkPairFilter& filter,
                            const LinkMargins& margins) {
  if (engine == "simd") return RobotHierarchy<Simd>(model, filter, margins);
  if (engine == "lazy") return RobotHierarchy<Lazy>(model, filter, margins);
  if (engine == "brute") return RobotHierarchy<Brute>(model, filter, margins);
  throw ModelError("engine '" + engine + "': expected simd, lazy or brute");
}

}  // namespace hinge::robotics
