// SPDX-License-Identifier: BSD-3-Clause
// find_inside: finds components of a link inside a solid that do not touch its surface, at the current state.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "checking/solids.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/containment.hpp"
#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// A component of `inner` with a vertex inside a solid of `outer`: it lies inside, or the surfaces touch.
struct Inside {
  LinkId outer{};
  LinkId inner{};
  PrimitiveId outer_triangle{};  ///< first triangle of the solid
  PrimitiveId inner_triangle{};  ///< a triangle of the component
  Vec3 point = Vec3::Zero();     ///< a vertex of the component, world frame

  /// Returns the pair as queries of one model report it, with first < second and distance 0.
  Hit hit(double threshold) const noexcept {
    return outer_triangle < inner_triangle ? Hit{outer_triangle, inner_triangle, 0.0, threshold}
                                           : Hit{inner_triangle, outer_triangle, 0.0, threshold};
  }
};

/// Returns false only if the point is certainly outside the solid. link: world pose of the solid's link.
inline bool may_be_in(const Solid& solid, const Pose& link, const Vec3& point) noexcept {
  const Pose frame = link * solid.frame;
  const Vec3 away = point - frame.translation;
  // Allows for rotations that deviate by 1e-9 per joint and for rounding relative to the coordinates.
  double slack = 0.0;
  for (int k = 0; k < 3; ++k)
    slack += 1e-6 * solid.half[k] + 1e-12 * (std::abs(point[k]) + std::abs(frame.translation[k]));
  for (int k = 0; k < 3; ++k)
    if (std::abs(dot(Vec3(frame.rotation.col(k)), away)) > solid.half[k] + slack) return false;
  return true;
}

/// Returns true if the world point is inside the solid. Exact for the placed coordinates.
template <class H>
bool is_in(H& outer, const Solid& solid, const Vec3& point) {
  std::vector<Triangle> surface;
  surface.reserve(solid.count);
  for (std::size_t k = 0; k < solid.count; ++k) surface.push_back(outer.placed(id<PrimitiveId>(solid.first + k)));
  return place_of(point, surface) == Place::inside;
}

/// Calls found(inside) for each component of link `inner` inside the solid, until it returns true. Returns true in that
/// case.
template <class H, class G, class Found>
bool find_inside(H& outer_model, const Solid& solid, G& inner_model, const Solids& inner_solids, LinkId inner,
                 const Found& found) {
  const Pose outer_pose = outer_model.link_pose(solid.link), inner_pose = inner_model.link_pose(inner);
  for (const SolidPart& part : inner_solids.parts(inner)) {
    if (!may_hold(solid, part) || !may_be_in(solid, outer_pose, inner_pose * part.point)) continue;
    const Vec3 point = inner_model.placed(part.triangle).a;
    if (is_in(outer_model, solid, point) &&
        found(Inside{solid.link, inner, id<PrimitiveId>(solid.first), part.triangle, point}))
      return true;
  }
  return false;
}

/// The solids of a robot, each with the links that are tested against it.
class SolidPairs {
 public:
  SolidPairs() = default;
  /// Works for any hierarchy of the robot, with any rigid groups.
  template <class H>
  SolidPairs(const H& hierarchy, const Robot& robot, const LinkPairs& tested) {
    const Solids& solids = robot.solids();
    const RigidGroups& groups = *hierarchy.model().groups();
    const auto add_ball = [&](LinkId link, const Vec3& centre, double radius) {
      balls_.push_back({groups.group_of(link), groups.link_in_group(link) * centre, radius});
      return balls_.size() - 1;
    };
    std::vector<std::size_t> ball_of(robot.link_count(), 0);  // 0: not made yet
    for (const Solid& solid : solids.all()) {
      const std::size_t own = add_ball(solid.link, solid.frame.translation, solid.radius);
      for (std::size_t l = 1; l < robot.link_count(); ++l) {
        const LinkId link = id<LinkId>(l);
        if (robot.triangle_count(link) == 0 || !tested.contains(solid.link, link)) continue;
        if (!solids.may_hold_any(solid, link)) continue;
        if (ball_of[l] == 0) {
          const BoundingBall points = solids.points(link);
          ball_of[l] = add_ball(link, points.centre, points.radius);
        }
        const double reach = (solid.radius + balls_[ball_of[l]].radius) * (1.0 + 1e-6);
        pairs_.push_back({own, ball_of[l], &solid, link, reach * reach});
      }
    }
  }

  /// Calls found(inside) for each containment, until it returns true. Returns true in that case. `hierarchy` is that of
  /// the constructor or a copy, `centres` is scratch. Skips pairs that no joint moves, as queries of surfaces do.
  template <class H, class Found>
  bool find(H& hierarchy, const Robot& robot, std::vector<std::array<double, 3>>& centres, const Found& found) const {
    if (pairs_.empty()) return false;
    centres.resize(balls_.size());
    const std::span<const Frame> frames = hierarchy.frames();
    for (std::size_t k = 0; k < balls_.size(); ++k) {
      const std::array<double, 16>& c = frames[index(balls_[k].group)].column;
      const Vec3& x = balls_[k].centre;
      for (std::size_t r = 0; r < 3; ++r) centres[k][r] = c[r] * x[0] + c[4 + r] * x[1] + c[8 + r] * x[2] + c[12 + r];
    }
    for (const Pair& pair : pairs_) {
      const std::array<double, 3>&a = centres[pair.outer], &b = centres[pair.inner];
      double squared = 0.0, rounding = 0.0;
      for (std::size_t r = 0; r < 3; ++r) {
        squared += (b[r] - a[r]) * (b[r] - a[r]);
        rounding += a[r] * a[r];
      }
      // Balls too far apart. Written so that NaN and overflow are tested further.
      if (squared > pair.squared_reach + 1e-20 * rounding && squared <= 1e300) continue;
      const auto judge = [&](const Inside& inside) {
        return !hierarchy.model().constant(inside.outer_triangle, inside.inner_triangle) && found(inside);
      };
      if (find_inside(hierarchy, *pair.solid, hierarchy, robot.solids(), pair.link, judge)) return true;
    }
    return false;
  }

 private:
  struct GroupBall {
    GroupId group{};
    Vec3 centre = Vec3::Zero();
    double radius = 0.0;
  };
  struct Pair {
    std::size_t outer = 0, inner = 0;  // indices into balls_
    const Solid* solid = nullptr;      // owned by the robot
    LinkId link{};
    double squared_reach = 0.0;
  };
  std::vector<GroupBall> balls_;
  std::vector<Pair> pairs_;
};

}  // namespace hinge::robotics
