// SPDX-License-Identifier: BSD-3-Clause
// Helpers for queries between two hierarchies: same engine, combined clearance, contacts per pair of links.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "checking/closeness.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/core/radius_sum.hpp"
#include "hinge/detail/query/pair_threshold.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/query/link_pair_hits.hpp"
#include "hinge/query/query_options.hpp"
#include "hinge/robotics/any_hierarchy.hpp"
#include "hinge/robotics/contact.hpp"
#include "hinge/robotics/link_margins.hpp"

namespace hinge::robotics {

/// Throws ConfigurationError if the margin is negative or not finite.
inline void check_margin(double margin) {
  if (!is_finite(margin) || margin < 0.0)
    throw ConfigurationError("margin " + number_text(margin) + ": expected a finite length >= 0");
}

/// Calls ask(mine, theirs) with both hierarchies as one type. Throws ModelError if the engines differ, or if both are
/// the same object.
template <class Ask>
auto with_same_engine(AnyHierarchy& mine, AnyHierarchy& theirs, const Ask& ask) {
  return std::visit(
      [&](auto& first) {
        using H = std::remove_reference_t<decltype(first)>;
        H* const second = std::get_if<H>(&theirs);
        if (second == nullptr)
          throw ModelError("a query between two models: they use different engines, expected one engine for both");
        if (second == &first) throw ModelError("a query between a robot and itself: expected two robots");
        return ask(first, *second);
      },
      mine);
}

/// Returns the difference (m) between the larger clearance and the one that LinkMargins uses between two models.
inline double missing_clearance(double clearance, double other_clearance) noexcept {
  return std::max(clearance, other_clearance) - (clearance / 2 + other_clearance / 2);
}

/// Returns the same extra clearance (m) for every group, or an empty list if it is 0.
inline std::vector<double> for_all_groups(const AnyHierarchy& any, double clearance) {
  if (clearance == 0.0) return {};
  return std::visit([&](const auto& h) { return std::vector<double>(h.model().groups()->size(), clearance); }, any);
}

inline std::vector<double> filling(const AnyHierarchy& mine, double clearance, double other_clearance) {
  return for_all_groups(mine, missing_clearance(clearance, other_clearance));
}

/// Measures a hit. sum: its threshold.
template <class H>
Closeness measure(H& mine, H& theirs, const Hit& hit, const RadiusSum& sum) {
  return closeness(triangle_at(mine, hit.first), triangle_at(theirs, hit.second), sum);
}

/// Returns the closest pair between two models and its numbers. If any pair is a hit, the result is a hit, even if
/// rounding gives another pair a slightly smaller gap.
template <class H, class G>
std::optional<std::pair<Hit, Closeness>> closest_between(H& mine, const LinkMargins& margins, H& theirs,
                                                         const LinkMargins& other_margins, const G& across,
                                                         const QueryOptions& options) {
  const auto measured = [&](const Hit& hit) {
    const double more = detail::clearance_of(options.clearance, mine.model().group_of(hit.first)) +
                        detail::clearance_of(options.other_clearance, theirs.model().group_of(hit.second));
    return measure(mine, theirs, hit, margins.sum(hit.first, other_margins, hit.second) + more);
  };
  std::optional<Hit> hit = mine.closest(theirs, across, options);
  if (!hit) return {};
  Closeness found = measured(*hit);
  if (!found.collides && mine.collides(theirs, across, options)) {
    hit = mine.collisions(theirs, across, options).front();
    found = measured(*hit);
  }
  return std::pair(*hit, found);
}

/// Returns one hit per pair of links with d - M < margin (m), sorted by links.
template <class H, class G>
std::vector<LinkContact> links_within(H& mine, H& theirs, double margin, const G& across, const QueryOptions& options) {
  const std::span<const LinkId> links = mine.model().model().links(), other_links = theirs.model().model().links();
  LinkPairHits found(links, other_links, margin);
  mine.query(theirs, found, across, options);
  std::vector<LinkContact> contacts;
  for (const Hit& hit : found.hits())
    contacts.push_back({links[index(hit.first)], other_links[index(hit.second)], hit});
  return contacts;
}

}  // namespace hinge::robotics
