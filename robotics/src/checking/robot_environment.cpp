// SPDX-License-Identifier: BSD-3-Clause
// Implements queries of a robot and its held bodies against the bodies of an environment.
#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "approximation/placed_box.hpp"
#include "checking/body_insides.hpp"
#include "checking/body_pairs.hpp"
#include "hinge/core/error.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/robot_checker.hpp"

namespace hinge::robotics {

namespace {

constexpr auto any_hit = [](auto& mine, auto& theirs, const auto& filter, const QueryOptions& options) {
  return mine.collides(theirs, filter, options);
};

}  // namespace

std::span<const Aabb> RobotChecker::link_boxes() {
  if (link_boxes_stand_) return link_boxes_;
  link_boxes_.resize(local_boxes_->size());
  for (std::size_t l = 0; l < local_boxes_->size(); ++l)
    if (!(*local_boxes_)[l].is_empty()) link_boxes_[l] = placed_box((*local_boxes_)[l], link_pose(id<LinkId>(l)));
  link_boxes_stand_ = true;
  return link_boxes_;
}

/// Moves held bodies to their links, then returns the pairs whose boxes do not exclude d - M <= margin.
std::vector<RobotChecker::BodyPair> RobotChecker::body_pairs(Environment& environment, double margin) {
  if (environment.engine() != engine_)
    throw ModelError("the environment uses engine '" + environment.engine() + "', the robot uses engine '" + engine_ +
                     "', expected one engine for both");
  std::vector<BodyPair> bodies;
  for (const BodyId name : environment.bodies()) {
    Environment::Body& body = environment.at(name);
    bodies.push_back({nullptr, {}, &body, name, Environment::may_touch(body, *robot_)});
    if (!Environment::held_by(body, robot_.get())) continue;
    const Pose pose = link_pose(body.attachment->link) * body.attachment->in_link;
    if (!(pose == body.pose)) Environment::place(body, pose);
  }
  const std::span<const Aabb> boxes = link_boxes();
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<BodyPair> pairs;
  const double clearance = std::max(margins_.clearance(), environment.clearance());
  for (BodyPair pair : bodies) {
    pair.lower = infinity;
    for (std::size_t l = 1; l < local_boxes_->size(); ++l)
      if (!(*local_boxes_)[l].is_empty() && pair.tests(l))
        pair.lower = std::min(pair.lower, separation(boxes[l], pair.body->box) - clearance);
    if (!(pair.lower > margin)) pairs.push_back(pair);
  }
  for (const BodyPair& held : bodies) {
    if (!Environment::held_by(*held.body, robot_.get())) continue;
    for (BodyPair pair : bodies) {
      // Count a pair of held bodies once. Skip it if one rigid group holds both: they never move against each other.
      if (Environment::held_by(*pair.body, robot_.get()) &&
          (pair.body_id <= held.body_id || pair.body->attachment->group == held.body->attachment->group))
        continue;
      pair.held = held.body;
      pair.held_id = held.body_id;
      pair.may_touch.clear();
      pair.lower = separation(held.body->box, pair.body->box) - environment.clearance();
      if (!(pair.lower > margin)) pairs.push_back(pair);
    }
  }
  return pairs;
}

void RobotChecker::calibrate_pair_order(Environment& environment) {
  for (const BodyPair& pair : body_pairs(environment, 0.0))
    if (pair.held == nullptr)
      ask(pair, environment, [](auto& mine, auto& theirs, const auto& filter, const QueryOptions&) {
        mine.calibrate_pair_order(theirs, filter);
      });
}

bool RobotChecker::collides(Environment& environment) {
  const std::vector<BodyPair> pairs = body_pairs(environment, 0.0);
  const auto meets = [&](const BodyPair& pair) { return ask(pair, environment, any_hit); };
  const auto any = [](const BodyContact&, const Vec3&) { return true; };
  return std::any_of(pairs.begin(), pairs.end(), meets) ||
         std::any_of(pairs.begin(), pairs.end(), [&](const BodyPair& p) { return find_insides(p, environment, any); });
}

std::vector<BodyContact> RobotChecker::within(Environment& environment, double margin) {
  check_margin(margin);
  const std::vector<BodyPair> pairs = body_pairs(environment, margin);
  std::vector<BodyContact> contacts = surfaces_within(environment, pairs, margin);
  const auto order = [](const BodyContact& c) { return std::tie(c.held, c.link, c.body); };
  for (const BodyPair& pair : pairs)
    find_insides(pair, environment, [&](const BodyContact& contact, const Vec3&) {
      const auto at = std::lower_bound(contacts.begin(), contacts.end(), contact,
                                       [&](const auto& x, const auto& y) { return order(x) < order(y); });
      if (at != contacts.end() && order(*at) == order(contact)) {
        *at = contact;
      } else {
        contacts.insert(at, contact);
      }
      return false;
    });
  return contacts;
}

std::vector<BodyContact> RobotChecker::surfaces_within(const Environment& environment,
                                                       const std::vector<BodyPair>& pairs, double margin) {
  std::vector<BodyContact> contacts;
  for (const BodyPair& pair : pairs) {
    const std::vector<LinkContact> found =
        ask(pair, environment, [&](auto& mine, auto& theirs, const auto& filter, const QueryOptions& options) {
          return links_within(mine, theirs, margin, filter, options);
        });
    for (const LinkContact& contact : found)
      contacts.push_back({pair.held != nullptr ? pair.held->attachment->link : contact.link1,
                          pair.held != nullptr ? std::optional(pair.held_id) : std::nullopt, pair.body_id,
                          contact.hit});
  }
  // An empty `held` is the smallest value, so links come first. A held body determines its link.
  std::sort(contacts.begin(), contacts.end(), [](const BodyContact& x, const BodyContact& y) {
    return std::tie(x.held, x.link, x.body) < std::tie(y.held, y.link, y.body);
  });
  return contacts;
}

std::optional<ClosestBody> RobotChecker::closest(Environment& environment) {
  std::vector<BodyPair> pairs = body_pairs(environment, std::numeric_limits<double>::infinity());
  std::stable_sort(pairs.begin(), pairs.end(), [](const BodyPair& x, const BodyPair& y) { return x.lower < y.lower; });
  std::optional<ClosestBody> best;
  for (const BodyPair& pair : pairs) {
    // No later pair can be closer.
    if (best && pair.lower > best->gap) break;
    // Ask the cheap yes/no question first: is any pair closer than the best one? Usually not.
    if (best && !ask(pair, environment, any_hit, std::max(best->gap, 0.0))) continue;
    const auto found =
        ask(pair, environment, [&](auto& mine, auto& theirs, const auto& filter, const QueryOptions& options) {
          return closest_between(mine, mine.matrix(), theirs, theirs.matrix(), filter, options);
        });
    if (!found) continue;
    const auto& [hit, numbers] = *found;
    // A hit precedes a pair that is no hit, even if rounding gives both a gap of 0.
    if (best && !(std::pair(!numbers.collides, numbers.gap) < std::pair(!best->collides(), best->gap))) continue;
    best = ClosestBody{};
    if (pair.held != nullptr) best->held = pair.held_id;
    best->link = pair.held != nullptr ? pair.held->attachment->link : robot_->model().links()[index(hit.first)];
    best->body = pair.body_id;
    best->triangle1 = hit.first;
    best->triangle2 = hit.second;
    best->distance = numbers.distance;
    best->gap = numbers.gap;
    best->point1 = numbers.point1;
    best->point2 = numbers.point2;
  }
  for (const BodyPair& pair : pairs) {
    if (pair.lower > 0.0) break;  // boxes apart: no containment
    find_insides(pair, environment, [&](const BodyContact& contact, const Vec3& point) {
      const double gap = -contact.hit.threshold;
      if (!best || std::pair(gap, 0.0) < std::pair(best->gap, best->distance))
        best = ClosestBody{contact.link, contact.held, contact.body, contact.hit.first, contact.hit.second, 0.0,
                           gap,          point,        point};
      return false;
    });
  }
  return best;
}

}  // namespace hinge::robotics
