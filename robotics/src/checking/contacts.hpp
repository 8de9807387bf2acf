// SPDX-License-Identifier: BSD-3-Clause
// Helpers that merge contacts of surfaces with contacts inside solids.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "checking/closeness.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/robotics/contact.hpp"

namespace hinge::robotics {

/// Inserts a contact into a sorted list, or replaces the contact of the same links.
inline void put_contact(std::vector<LinkContact>& contacts, const LinkContact& contact) {
  const auto links = [](const LinkContact& c) { return std::pair(c.link1, c.link2); };
  const auto at = std::lower_bound(contacts.begin(), contacts.end(), contact,
                                   [&](const auto& x, const auto& y) { return links(x) < links(y); });
  if (at != contacts.end() && links(*at) == links(contact)) {
    *at = contact;
  } else {
    contacts.insert(at, contact);
  }
}

/// Replaces `best` by the pair of `contact` if its d - M is smaller, or if it is equal and `best` does not touch. The
/// links of `contact` share `point` (world).
inline void take_closer(std::optional<ClosestLinks>& best, const LinkContact& contact, const Vec3& point) {
  const double gap = -contact.hit.threshold;
  if (best && !(std::pair(gap, 0.0) < std::pair(best->gap, best->distance))) return;
  best = ClosestLinks{contact.link1, contact.link2, contact.hit.first, contact.hit.second, 0.0, gap, point, point};
}

/// Combines a hit with its numbers.
inline ClosestLinks answer(LinkId link1, LinkId link2, const Hit& hit, const Closeness& found) {
  return {link1, link2, hit.first, hit.second, found.distance, found.gap, found.point1, found.point2};
}

}  // namespace hinge::robotics
