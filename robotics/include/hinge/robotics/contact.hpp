// SPDX-License-Identifier: BSD-3-Clause
// What robot queries answer with: pairs of links, or of a link and a body, and the closest of them. Metres, world
// frame.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>

#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge::robotics {

/// A body of an Environment. Never given out twice.
enum class BodyId : std::uint32_t {};

/// Two links too close, and one pair of triangles that shows it (any of them), hit.first on link1. Within a robot
/// link1 < link2; between two robots link1 is of the one asked. hit.distance is that of the triangles, radii not taken
/// off.
struct LinkContact {
  LinkId link1{};
  LinkId link2{};
  Hit hit;
};

/// The closest pair of links. Triangles by their positions in Robot::model(). collides() and this never contradict each
/// other: the pair collides exactly when gap < 0 or distance == 0.
struct ClosestLinks {
  LinkId link1{};
  LinkId link2{};
  PrimitiveId triangle1{};
  PrimitiveId triangle2{};
  /// Of the surfaces, radii taken off; >= 0, and 0 exactly when they meet. Right to a few ulps of the coordinates.
  double distance = 0.0;
  double gap = 0.0;            ///< d - M: distance minus clearance where the surfaces are apart
  Vec3 point1 = Vec3::Zero();  ///< on link1; where the two meet, one point twice
  Vec3 point2 = Vec3::Zero();

  bool collides() const noexcept { return gap < 0.0 || distance == 0.0; }
};

/// A link too close to a body or, when `held` is there, a body that hangs on `link` too close to another body.
/// hit.first is a triangle of the link (or the held body), hit.second one of `body`.
struct BodyContact {
  LinkId link{};
  std::optional<BodyId> held{};
  BodyId body{};
  Hit hit;
};

/// The closest of those pairs; numbers as in ClosestLinks, point1 on the link (or the held body).
struct ClosestBody {
  LinkId link{};
  std::optional<BodyId> held{};
  BodyId body{};
  PrimitiveId triangle1{};
  PrimitiveId triangle2{};
  double distance = 0.0;
  double gap = 0.0;
  Vec3 point1 = Vec3::Zero();
  Vec3 point2 = Vec3::Zero();

  bool collides() const noexcept { return gap < 0.0 || distance == 0.0; }
};

}  // namespace hinge::robotics
