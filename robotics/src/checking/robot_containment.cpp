// SPDX-License-Identifier: BSD-3-Clause
// Finds links and bodies inside others whose surfaces do not collide.
#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "checking/body_pairs.hpp"
#include "hinge/robotics/containment.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/robot_checker.hpp"

namespace hinge::robotics {

const RobotChecker::Topology& RobotChecker::topology() {
  if (topology_) return *topology_;
  const std::span<const Triangle> triangles = robot_->model().primitives();
  Topology found;
  found.is_closed.assign(robot_->link_count(), 0);
  found.parts.resize(robot_->link_count());
  std::size_t first = 0;
  for (std::size_t l = 0; l < robot_->link_count(); ++l) {
    const LinkId link = id<LinkId>(l);
    const std::span<const Triangle> mesh = triangles.subspan(first, robot_->triangle_count(link));
    found.first.push_back(first);
    first += mesh.size();
    if (mesh.empty()) continue;
    found.parts[l] = parts(mesh);
    const std::optional<OpenEdge> open = open_edge(mesh);
    found.is_closed[l] = open ? 0 : 1;
    if (open) found.open.push_back({link, *open});
  }
  topology_ = std::make_shared<const Topology>(std::move(found));
  return *topology_;
}

std::span<const OpenLink> RobotChecker::not_closed() { return topology().open; }

std::span<const Triangle> RobotChecker::placed(LinkId link) {
  return std::visit([](auto& hierarchy) { return hierarchy.placed(); }, *hierarchy_)
      .subspan(topology().first[index(link)], robot_->triangle_count(link));
}

std::vector<LinkContainment> RobotChecker::contained() {
  std::set<std::pair<LinkId, LinkId>> colliding;
  for (const LinkContact& contact : surfaces_within(0.0)) colliding.emplace(contact.link1, contact.link2);
  std::vector<LinkContainment> found;
  const auto look = [&](LinkId outer, LinkId inner) {
    if (topology().is_closed[index(outer)] == 0) return;
    const Containment how = contains(placed(outer), placed(inner), topology().parts[index(inner)]);
    if (how != Containment::none) found.push_back({outer, inner, how == Containment::whole});
  };
  const std::span<const Aabb> boxes = link_boxes();
  for (const auto& [a, b] : tested().list()) {
    if (!overlap(boxes[index(a)], boxes[index(b)]) || colliding.contains({a, b})) continue;
    look(a, b);
    look(b, a);
  }
  std::sort(found.begin(), found.end(), [](const LinkContainment& x, const LinkContainment& y) {
    return std::tie(x.outer, x.inner) < std::tie(y.outer, y.inner);
  });
  return found;
}

std::vector<BodyContainment> RobotChecker::contained(Environment& environment) {
  std::set<std::tuple<std::optional<BodyId>, LinkId, BodyId>> colliding;
  const std::vector<BodyPair> pairs = body_pairs(environment, 0.0);
  for (const BodyContact& contact : surfaces_within(environment, pairs, 0.0))
    colliding.emplace(contact.held, contact.link, contact.body);
  const auto placed_body = [](Environment::Body& body) {
    return std::visit([](auto& hierarchy) { return hierarchy.placed(); }, body.hierarchy);
  };
  std::vector<BodyContainment> found;
  for (const BodyPair& pair : pairs) {
    const Environment::Topology& of_body = Environment::topology(*pair.body);
    /// `first`: triangles of the link or of the held body. The other side is pair.body.
    const auto look = [&](BodyContainment which, std::span<const Triangle> first, std::span<const std::size_t> parts,
                          bool first_is_closed) {
      if (colliding.contains({which.held, which.link, which.body})) return;
      const std::span<const Triangle> second = placed_body(*pair.body);
      for (const bool body_is_outer : {true, false}) {
        if (!(body_is_outer ? !of_body.open.has_value() : first_is_closed)) continue;
        const Containment how = body_is_outer ? contains(second, first, parts) : contains(first, second, of_body.parts);
        which.body_is_outer = body_is_outer;
        which.whole = how == Containment::whole;
        if (how != Containment::none) found.push_back(which);
      }
    };
    if (pair.held != nullptr) {
      const Environment::Topology& of_held = Environment::topology(*pair.held);
      look({pair.held->attachment->link, pair.held_id, pair.body_id}, placed_body(*pair.held), of_held.parts,
           !of_held.open.has_value());
      continue;
    }
    const std::span<const Aabb> boxes = link_boxes();
    for (std::size_t l = 1; l < robot_->link_count(); ++l) {
      const LinkId link = id<LinkId>(l);
      const bool is_tested = robot_->triangle_count(link) > 0 && pair.tests(l);
      if (is_tested && overlap(boxes[l], pair.body->box))
        look({link, {}, pair.body_id}, placed(link), topology().parts[l], topology().is_closed[l] != 0);
    }
  }
  std::sort(found.begin(), found.end(), [](const BodyContainment& x, const BodyContainment& y) {
    return std::tie(x.held, x.link, x.body, x.body_is_outer) < std::tie(y.held, y.link, y.body, y.body_is_outer);
  });
  return found;
}

}  // namespace hinge::robotics
