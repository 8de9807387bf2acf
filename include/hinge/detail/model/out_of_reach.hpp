// SPDX-License-Identifier: BSD-3-Clause
// out_of_reach: finds the primitives at rest that no moving primitive can approach, for any values of the joints.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// A ball about a point of the first joint axis of a chain. It contains the chain for all values of its joints.
struct ChainBall {
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;
  double largest = 0.0;  ///< largest length in the sums: their rounding error is proportional to it

  void contain(const Vec3& point, double margin) noexcept {
    radius = std::max(radius, norm(Vec3(point - centre)) + margin);
    largest = std::max({largest, norm(point), norm(centre), radius});
  }
};

/// Returns one value per primitive: 1 if the primitive belongs to group 0 and stays farther than its threshold from all
/// primitives of other groups, for any values of the joints; otherwise 0. The proof adds up the lengths between the
/// joints of each chain of groups. Time: O(primitives of group 0 x chains). If more than most_chains start at group 0,
/// it returns zeros: hardly any primitive is out of reach then.
template <Primitive P, DistanceMatrix D>
std::vector<std::uint8_t> out_of_reach(const SelectedModel<P>& model, const D& matrix) {
  constexpr std::size_t most_chains = 256;
  constexpr double rounding = 1e-9;  // relative: far above the errors of the sums and of forward kinematics
  const auto middle = [&](PrimitiveId i) {
    const Aabb box = model.primitives()[index(i)].bounds();
    return Vec3(box.middle(0), box.middle(1), box.middle(2));
  };
  const auto margin = [&](PrimitiveId i) {  // half the diagonal of the bounds, and the threshold radius
    const Aabb box = model.primitives()[index(i)].bounds();
    return 0.5 * norm(Vec3(box.length(0), box.length(1), box.length(2))) + matrix.reach(i);
  };
  std::vector<std::uint8_t> out(model.size(), 0);
  const RigidGroups& groups = *model.groups();
  std::vector<ChainBall> balls(groups.size());  // in the frame of the group
  std::vector<ChainBall> chains;                // balls of the chains that start at group 0, in its frame
  for (std::size_t g = 1; g < groups.size(); ++g) {
    const Joint& joint = groups[id<GroupId>(g)].joint;
    balls[g].centre = joint.point;
    if (joint.kind == JointKind::prismatic) balls[g].radius = std::numeric_limits<double>::infinity();
  }
  for (std::size_t g = groups.size(); g-- > 1;) {  // children come before their parents
    const RigidGroup& group = groups[id<GroupId>(g)];
    ChainBall& ball = balls[g];
    for (const PrimitiveId i : model.primitives_of(id<GroupId>(g))) ball.contain(middle(i), margin(i));
    // The joint turns the ball about its centre.
    const Vec3 centre = group.joint.origin * ball.centre;
    if (group.parent != GroupId{0}) {
      balls[index(group.parent)].contain(centre, ball.radius);
      continue;
    }
    chains.push_back({centre, ball.radius, std::max(ball.largest, norm(centre))});
    if (chains.size() > most_chains) return out;
  }
  for (const PrimitiveId i : model.primitives_of(GroupId{0})) {
    const Vec3 point = middle(i);
    const double own = margin(i);
    const auto out_of = [&](const ChainBall& chain) {
      return norm(Vec3(point - chain.centre)) > chain.radius + own + rounding * (chain.largest + norm(point) + own);
    };
    out[index(i)] = std::all_of(chains.begin(), chains.end(), out_of) ? 1 : 0;
  }
  return out;
}

}  // namespace hinge::detail
