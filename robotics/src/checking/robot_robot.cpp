// SPDX-License-Identifier: BSD-3-Clause
// Implements queries of a robot against another robot.
#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "approximation/between.hpp"
#include "checking/body_pairs.hpp"
#include "checking/contacts.hpp"
#include "checking/find_inside.hpp"
#include "hinge/bounds/aabb.hpp"
#include "hinge/robotics/robot_checker.hpp"

namespace hinge::robotics {

/// Calls found(contact, point) for each containment between the two robots, with a common point (world), until it
/// returns true.
template <class Found>
bool RobotChecker::find_insides(RobotChecker& other, const Found& found) {
  const Robot &mine = *robot_, &theirs = *other.robot_;
  if (mine.solids().all().empty() && theirs.solids().all().empty()) return false;
  const std::span<const Aabb> boxes = link_boxes(), other_boxes = other.link_boxes();
  const double threshold = std::max(margins_.clearance(), other.margins_.clearance());
  return with_same_engine(*hierarchy_, *other.hierarchy_, [&](auto& first, auto& second) {
    for (std::size_t k = 1; k < boxes.size(); ++k)
      for (std::size_t l = 1; l < other_boxes.size(); ++l) {
        const LinkId a = id<LinkId>(k), b = id<LinkId>(l);
        if (mine.triangle_count(a) == 0 || theirs.triangle_count(b) == 0 || !overlap(boxes[k], other_boxes[l]))
          continue;
        const auto tell = [&](const Inside& inside, PrimitiveId of_mine, PrimitiveId of_theirs) {
          return found(LinkContact{a, b, Hit{of_mine, of_theirs, 0.0, threshold}}, inside.point);
        };
        for (const Solid& solid : mine.solids().of(a))
          if (find_inside(first, solid, second, theirs.solids(), b, [&](const Inside& inside) {
                return tell(inside, inside.outer_triangle, inside.inner_triangle);
              }))
            return true;
        for (const Solid& solid : theirs.solids().of(b))
          if (find_inside(second, solid, first, mine.solids(), a, [&](const Inside& inside) {
                return tell(inside, inside.inner_triangle, inside.outer_triangle);
              }))
            return true;
      }
    return false;
  });
}

// OtherLinks admits every pair here. AdmitAll would do, but all queries would be compiled a second time.

bool RobotChecker::collides(RobotChecker& other) {
  const std::vector<double> more = filling(*hierarchy_, margins_.clearance(), other.margins_.clearance());
  return with_same_engine(*hierarchy_, *other.hierarchy_,
                          [&](auto& mine, auto& theirs) {
                            return mine.collides(theirs, OtherLinks{robot_->model().links()}, {false, more});
                          }) ||
         find_insides(other, [](const LinkContact&, const Vec3&) { return true; });
}

std::vector<LinkContact> RobotChecker::within(RobotChecker& other, double margin) {
  check_margin(margin);
  const std::vector<double> more = filling(*hierarchy_, margins_.clearance(), other.margins_.clearance());
  std::vector<LinkContact> contacts = with_same_engine(*hierarchy_, *other.hierarchy_, [&](auto& mine, auto& theirs) {
    return links_within(mine, theirs, margin, OtherLinks{robot_->model().links()}, {false, more});
  });
  find_insides(other, [&](const LinkContact& contact, const Vec3&) {
    put_contact(contacts, contact);
    return false;
  });
  return contacts;
}

std::optional<ClosestLinks> RobotChecker::closest(RobotChecker& other) {
  const std::vector<double> more = filling(*hierarchy_, margins_.clearance(), other.margins_.clearance());
  auto best =
      with_same_engine(*hierarchy_, *other.hierarchy_, [&](auto& mine, auto& theirs) -> std::optional<ClosestLinks> {
        const auto found =
            closest_between(mine, margins_, theirs, other.margins_, OtherLinks{robot_->model().links()}, {false, more});
        if (!found) return {};
        return answer(robot_->model().links()[index(found->first.first)],
                      other.robot_->model().links()[index(found->first.second)], found->first, found->second);
      });
  find_insides(other, [&](const LinkContact& contact, const Vec3& point) {
    take_closer(best, contact, point);
    return false;
  });
  return best;
}

}  // namespace hinge::robotics
