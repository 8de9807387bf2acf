// SPDX-License-Identifier: BSD-3-Clause
// Between: queries of two hierarchies with one engine, and clearances of the two made one.
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
#include "hinge/detail/query/pair_rules.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/query/link_pair_hits.hpp"
#include "hinge/query/query_options.hpp"
#include "hinge/robotics/any_hierarchy.hpp"
#include "hinge/robotics/contact.hpp"
#include "hinge/robotics/link_margins.hpp"

namespace hinge::robotics {

inline void check_margin(double margin) {
  if (!is_finite(margin) || margin < 0.0)
    throw ConfigurationError("margin " + number_text(margin) + ": expected a finite length >= 0");
}

/// Calls ask(mine, theirs). ModelError: two engines, or one and the same hierarchy.
template <class Ask>
auto with_same_engine(AnyHierarchy& mine, AnyHierarchy& theirs, const Ask& ask) {
  return std::visit(
      [&](auto& first) {
        using H = std::remove_reference_t<decltype(first)>;
        H* const second = std::get_if<H>(&theirs);
        if (second == nullptr) throw ModelError("a query between two models: expected both to use the same engine");
        if (second == &first) throw ModelError("a query between a robot and itself: expected two robots");
        return ask(first, *second);
      },
      mine);
}

/// What LinkMargins lacks between two models to the larger of their clearances.
inline double missing_clearance(double clearance, double other_clearance) noexcept {
  return std::max(clearance, other_clearance) - (clearance / 2 + other_clearance / 2);
}

/// The same extra clearance for every group; an empty list for none.
inline std::vector<double> for_all_groups(const AnyHierarchy& any, double clearance) {
  if (clearance == 0.0) return {};
  return std::visit([&](const auto& h) { return std::vector<double>(h.model().groups()->size(), clearance); }, any);
}

inline std::vector<double> filling(const AnyHierarchy& mine, double clearance, double other_clearance) {
  return for_all_groups(mine, missing_clearance(clearance, other_clearance));
}

/// The numbers of a hit, of which `sum` is the threshold.
template <class H>
Closeness measure(H& mine, H& theirs, const Hit& hit, const RadiusSum& sum) {
  return closeness(triangle_at(mine, hit.first), triangle_at(theirs, hit.second), sum);
}

/// The closest pair between two models and its numbers; a hit whenever there is one, if need be one that rounding had
/// put a hair behind.
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

/// One hit of every pair of links with d - M < margin, by links.
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
