// SPDX-License-Identifier: BSD-3-Clause
// Results of robot queries: contacts and closest pairs of links and bodies. Lengths in m, points in the world frame.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>

#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge::robotics {

/// Names a body of an Environment. An environment never reuses an id.
enum class BodyId : std::uint32_t {};

/// Two links that are too close, with one arbitrary pair of triangles that shows it. hit.first belongs to link1. Within
/// one robot link1 < link2; between two robots link1 belongs to the queried robot. hit.distance is the distance of the
/// triangles, without subtracting their radii; it is 0 if one link is inside a solid of the other.
struct LinkContact {
  LinkId link1{};  ///< the link of hit.first
  LinkId link2{};  ///< the link of hit.second
  Hit hit;         ///< triangles as indices into Robot::model() of their robots
};

/// The closest pair of links. Consistent with the yes/no queries: the pair collides if and only if gap < 0 or distance
/// == 0.
struct ClosestLinks {
  LinkId link1{};           ///< order as in LinkContact
  LinkId link2{};           ///< the other link
  PrimitiveId triangle1{};  ///< index into Robot::model() of link1's robot
  PrimitiveId triangle2{};  ///< index into Robot::model() of link2's robot
  /// m, distance of the surfaces, radii subtracted. >= 0, and 0 if and only if the links touch or overlap. Accurate to
  /// a few ulps of the coordinates.
  double distance = 0.0;
  double gap = 0.0;            ///< m, d - M: distance minus clearance if the surfaces are apart
  Vec3 point1 = Vec3::Zero();  ///< on link1, world frame; equal to point2 if the links touch or overlap
  Vec3 point2 = Vec3::Zero();  ///< on link2, world frame

  /// Returns true if the pair touches, overlaps or is closer than its clearance.
  bool collides() const noexcept { return gap < 0.0 || distance == 0.0; }
};

/// A link that is too close to a body. If `held` is set: the body `held`, attached to `link`, is too close to another
/// body. hit.first is a triangle of the link (or of the held body), hit.second a triangle of `body`.
struct BodyContact {
  LinkId link{};                 ///< the link, or the link that holds `held`
  std::optional<BodyId> held{};  ///< the attached body; empty: the link itself
  BodyId body{};                 ///< the body that it is too close to
  Hit hit;                       ///< as in LinkContact
};

/// The closest pair of a link (or held body) and a body. Numbers as in ClosestLinks; point1 is on the link (or held
/// body), point2 on `body`.
struct ClosestBody {
  LinkId link{};                 ///< the link, or the link that holds `held`
  std::optional<BodyId> held{};  ///< the attached body; empty: the link itself
  BodyId body{};                 ///< the body that it is closest to
  PrimitiveId triangle1{};       ///< of the link or held body
  PrimitiveId triangle2{};       ///< of `body`
  double distance = 0.0;         ///< m, as in ClosestLinks
  double gap = 0.0;              ///< m, as in ClosestLinks
  Vec3 point1 = Vec3::Zero();    ///< on the link (or held body), world frame
  Vec3 point2 = Vec3::Zero();    ///< on `body`, world frame

  /// Returns true if the pair touches, overlaps or is closer than its clearance.
  bool collides() const noexcept { return gap < 0.0 || distance == 0.0; }
};

}  // namespace hinge::robotics
