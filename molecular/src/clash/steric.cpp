// SPDX-License-Identifier: BSD-3-Clause
// Implements Checker::steric.
#include <cstddef>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/molecular/checker.hpp"

namespace hinge::molecular {

Steric Checker::steric(std::span<const double> q, double softness) {
  if (!is_length(softness) || softness < 0.0)
    throw ConfigurationError("softness " + number_text(softness) + ": expected a finite length >= 0");
  return std::visit(
      [&](auto& hierarchy) {
        hierarchy.update(q);
        const auto& model = hierarchy.model();
        const RigidGroups& groups = *model.groups();
        Steric result{0.0, std::vector<double>(q.size(), 0.0)};
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
        const std::span<const Frame> frames = hierarchy.frames();
        for (std::size_t g = groups.size(); g-- > 1;) {
          const RigidGroup& group = groups[id<GroupId>(g)];
          const Pose pose = frames[g].pose();
          const Vec3 axis = product(pose.rotation, group.joint.axis);
          result.gradient[group.dof] =
              group.joint.kind == JointKind::prismatic
                  ? dot(axis, force[g])
                  : dot(axis, Vec3(moment[g] - cross(Vec3(pose * group.joint.point - centre), force[g])));
          force[index(group.parent)] += force[g];
          moment[index(group.parent)] += moment[g];
        }
        return result;
      },
      *hierarchy_);
}

}  // namespace hinge::molecular
