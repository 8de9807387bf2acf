// SPDX-License-Identifier: BSD-3-Clause
// Implements Checker::steric.
#include <cstddef>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/molecular/checker.hpp"
#include "motion/moved_atoms.hpp"

namespace hinge::molecular {

Steric Checker::steric(std::span<const double> q, double softness) {
  if (!is_length(softness) || softness < 0.0)
    throw ConfigurationError("softness " + number_text(softness) + ": expected a finite length >= 0");
  return std::visit(
      [&](auto& hierarchy) {
        hierarchy.update(q);
        const auto& model = hierarchy.model();
        const RigidGroups& groups = *model.groups();
        Steric result;
        // Per group: the sum of dE/dx over its atoms, and of x cross dE/dx about `centre`.
        std::vector<Vec3> force(groups.size(), Vec3::Zero()), moment(groups.size(), Vec3::Zero());
        Vec3 centre = Vec3::Zero();
        bool has_centre = false;
        // The pairs are sorted, so sums have the same bits for every engine and instruction set.
        for (const Hit& hit : hierarchy.self_within(softness)) {
          const Vec3 x = hierarchy.placed(hit.first).position, y = hierarchy.placed(hit.second).position;
          const double overlap = hit.threshold + softness - hit.distance;
          result.energy += overlap * overlap;
          if (hit.distance == 0.0) continue;
          if (!has_centre) centre = x;
          has_centre = true;
          const Vec3 pull = (x - y) * (-2.0 * overlap / hit.distance);
          const std::size_t g = index(model.group_of(hit.first)), h = index(model.group_of(hit.second));
          force[g] += pull;
          moment[g] += cross(Vec3(x - centre), pull);
          force[h] -= pull;
          moment[h] -= cross(Vec3(y - centre), pull);
        }
        std::vector<Pose> poses;
        for (const Frame& frame : hierarchy.frames()) poses.push_back(frame.pose());
        result.gradient = gradient_by_values(groups, poses, centre, force, moment, q.size());
        return result;
      },
      *hierarchy_);
}

}  // namespace hinge::molecular
