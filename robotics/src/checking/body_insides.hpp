// SPDX-License-Identifier: BSD-3-Clause
// find_insides: robot links inside solid bodies, and bodies inside solid links.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "approximation/between.hpp"
#include "checking/body_pairs.hpp"
#include "checking/find_inside.hpp"
#include "hinge/bounds/aabb.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/robotics/contact.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/robot_checker.hpp"

namespace hinge::robotics {

/// The result for a contact by containment: both closest points are `point`.
inline ClosestBody inside_of(const BodyContact& contact, const Vec3& point) noexcept {
  return {contact.link,           contact.held, contact.body, contact.hit.first, contact.hit.second, 0.0,
          -contact.hit.threshold, point,        point};
}
inline bool is_closer(const ClosestBody& x, const ClosestBody& y) noexcept {
  return std::pair(x.gap, x.distance) < std::pair(y.gap, y.distance);
}

/// Calls found(contact, point) for each containment, with a common point of both (world), until it returns true.
template <class Found>
bool RobotChecker::find_insides(const BodyPair& pair, const Environment& environment, const Found& found) {
  const Solids& of_body = pair.body->shape->solids();
  const LinkId body_link = Environment::body_link;
  const auto look = [&](auto& first, const Solids& solids, LinkId link, auto& second, BodyContact contact) {
    const auto tell = [&](const Inside& inside, PrimitiveId of_first, PrimitiveId of_second) {
      contact.hit.first = of_first;
      contact.hit.second = of_second;
      return found(contact, inside.point);
    };
    for (const Solid& solid : solids.of(link))
      if (find_inside(first, solid, second, of_body, body_link,
                      [&](const Inside& in) { return tell(in, in.outer_triangle, in.inner_triangle); }))
        return true;
    for (const Solid& solid : of_body.all())
      if (find_inside(second, solid, first, solids, link,
                      [&](const Inside& in) { return tell(in, in.inner_triangle, in.outer_triangle); }))
        return true;
    return false;
  };
  if (pair.held != nullptr) {
    const Solids& of_held = pair.held->shape->solids();
    if (of_held.all().empty() && of_body.all().empty()) return false;
    if (!overlap(pair.held->box, pair.body->box)) return false;
    return with_same_engine(pair.held->hierarchy, pair.body->hierarchy, [&](auto& first, auto& second) {
      return look(first, of_held, body_link, second,
                  {pair.held->attachment->link, pair.held_id, pair.body_id, Hit{{}, {}, 0.0, environment.clearance()}});
    });
  }
  const Solids& of_robot = robot_->solids();
  if (of_robot.all().empty() && of_body.all().empty()) return false;
  const double clearance = std::max(margins_.clearance(), environment.clearance());
  const std::span<const Aabb> boxes = link_boxes();
  return with_same_engine(*hierarchy_, pair.body->hierarchy, [&](auto& first, auto& second) {
    for (std::size_t l = 1; l < boxes.size(); ++l) {
      const LinkId link = id<LinkId>(l);
      if (robot_->triangle_count(link) == 0 || !pair.tests(l) || !overlap(boxes[l], pair.body->box)) continue;
      if (look(first, of_robot, link, second, {link, {}, pair.body_id, Hit{{}, {}, 0.0, clearance}})) return true;
    }
    return false;
  });
}

}  // namespace hinge::robotics
