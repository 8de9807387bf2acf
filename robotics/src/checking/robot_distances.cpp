// SPDX-License-Identifier: BSD-3-Clause
// Computes the closest points of every pair of links, or of a link and a body, within a margin.
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "approximation/between.hpp"
#include "checking/body_insides.hpp"
#include "checking/body_pairs.hpp"
#include "checking/closeness.hpp"
#include "checking/contacts.hpp"
#include "checking/find_inside.hpp"
#include "hinge/core/id.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/query/link_pair_hits.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/robot_checker.hpp"

namespace hinge::robotics {

namespace {

using LinkPair = std::pair<LinkId, LinkId>;

/// Collects for every pair of links the pair of triangles with the smallest d - M below the margin.
class ClosestOfPairs {
 public:
  static constexpr bool ranks = false;
  ClosestOfPairs(std::span<const LinkId> links, std::span<const LinkId> other_links, double margin)
      : links_(links), other_links_(other_links), margin_(margin) {}
  void add(const Hit& hit) {
    const auto [known, is_new] = best_.try_emplace({links_[index(hit.first)], other_links_[index(hit.second)]}, hit);
    const auto key = [](const Hit& h) { return std::tuple(h.gap(), h.first, h.second); };
    if (key(hit) < key(known->second)) known->second = hit;
  }
  double cutoff() const noexcept { return margin_; }
  bool done() const noexcept { return false; }
  const std::map<LinkPair, Hit>& best() const noexcept { return best_; }

 private:
  std::span<const LinkId> links_, other_links_;
  double margin_;
  std::map<LinkPair, Hit> best_;
};

static_assert(Collector<ClosestOfPairs>);

/// Collects the hit of one pair of links with the smallest d - M, the first one in the order of ClosestOfPairs. Ranked:
/// the search goes to the nearest boxes first, and ends at a contact if no triangle has a radius, because no pair is
/// closer. Not ranked: it looks at every hit that collides.
template <bool ranked>
class ClosestOfPair {
 public:
  static constexpr bool ranks = ranked;
  static constexpr bool keeps_smallest = ranked;
  /// known: a hit of the pair.
  ClosestOfPair(std::span<const LinkId> links, std::span<const LinkId> other_links, const Hit& known, bool has_radii)
      : links_(links),
        other_links_(other_links),
        pair_{links[index(known.first)], other_links[index(known.second)]},
        best_(known),
        has_radii_(has_radii) {}
  void add(const Hit& hit) {
    if (!wants(links_[index(hit.first)], other_links_[index(hit.second)])) return;
    const auto key = [](const Hit& h) { return std::tuple(h.gap(), h.first, h.second); };
    if (key(hit) < key(best_)) best_ = hit;
  }
  bool wants(LinkId a, LinkId b) const noexcept {
    return (a == pair_.first && b == pair_.second) ||
           (links_.data() == other_links_.data() && b == pair_.first && a == pair_.second);
  }
  double cutoff() const noexcept { return ranked ? best_.gap() : 0.0; }
  bool done() const noexcept { return ranked && !has_radii_ && best_.distance == 0.0; }
  const Hit& best() const noexcept { return best_; }

 private:
  std::span<const LinkId> links_, other_links_;
  LinkPair pair_;
  Hit best_;
  bool has_radii_;
};

static_assert(RefusesLinks<ClosestOfPair<true>> && KeepsSmallest<ClosestOfPair<true>>);

/// Returns for every pair of links within the margin (m) the hit with the smallest gap. query(collector) runs the
/// engine. Fine meshes have millions of pairs of triangles within a margin, so the simd engine first lists the pairs of
/// links and then searches the closest triangles of each. has_radii: a triangle may have a radius.
template <class Query>
std::map<LinkPair, Hit> closest_of_pairs(const std::string& engine, std::span<const LinkId> links,
                                         std::span<const LinkId> other_links, double margin, bool has_radii,
                                         const Query& query) {
  if (engine != "simd") {
    ClosestOfPairs all(links, other_links, margin);
    query(all);
    return all.best();
  }
  const bool self = links.data() == other_links.data();
  LinkPairHits met = self ? LinkPairHits(links, margin) : LinkPairHits(links, other_links, margin);
  query(met);
  std::map<LinkPair, Hit> best;
  for (const Hit& first : met.hits()) {
    ClosestOfPair<true> nearest(links, other_links, first, has_radii);
    if (!nearest.done() && (!has_radii || first.gap() > 0.0)) query(nearest);
    Hit found = nearest.best();
    // Of several contacts, take the deepest, the first of equal ones, as every engine does.
    if (found.distance == 0.0 || (has_radii && !(found.gap() > 0.0))) {
      ClosestOfPair<false> contacts(links, other_links, found, has_radii);
      query(contacts);
      found = contacts.best();
    }
    best.emplace(LinkPair(links[index(first.first)], other_links[index(first.second)]), found);
  }
  return best;
}

}  // namespace

std::vector<ClosestLinks> RobotChecker::surfaces_nearby(LinkId link, double margin) {
  const std::span<const LinkId> links = robot_->model().links();
  return std::visit(
      [&](auto& hierarchy) {
        // Rounding differs in this frame: enlarge the margin to keep the pairs that were within it.
        const double wider = margin * (1.0 + 0x1p-20) + 0x1p-20;
        std::vector<ClosestLinks> all;
        const auto ask = [&](auto& collector) { hierarchy.self_query(collector); };
        for (const auto& [pair, hit] : closest_of_pairs(engine_, links, links, wider, margins_.has_radii(), ask))
          if (pair.first == link)
            all.push_back(answer(pair.first, pair.second, hit,
                                 measure(hierarchy, hierarchy, hit, margins_.sum(hit.first, hit.second))));
        return all;
      },
      *nearby_);
}

std::vector<ClosestLinks> RobotChecker::distances(double margin) {
  check_margin(margin);
  const std::span<const LinkId> links = robot_->model().links();
  return std::visit(
      [&](auto& hierarchy) {
        const auto ask = [&](auto& collector) { hierarchy.self_query(collector); };
        std::map<LinkPair, ClosestLinks> found;
        std::set<LinkId> far;  // first links of the pairs far from the origin
        for (const auto& [pair, hit] : closest_of_pairs(engine_, links, links, margin, margins_.has_radii(), ask)) {
          found[pair] = answer(pair.first, pair.second, hit,
                               measure(hierarchy, hierarchy, hit, margins_.sum(hit.first, hit.second)));
          if (is_far(found[pair])) far.insert(pair.first);
        }
        for (const LinkId link : far) {
          const Pose frame = place_nearby(link);
          for (const ClosestLinks& closer : surfaces_nearby(link, margin))
            if (const auto known = found.find({closer.link1, closer.link2});
                known != found.end() && is_far(known->second))
              take_nearby(known->second, closer, frame);
        }
        solid_pairs_->find(hierarchy, *robot_, solid_centres_, [&](const Inside& inside) {
          const auto [a, b] = std::minmax(inside.outer, inside.inner);
          const auto known = found.find({a, b});
          std::optional<ClosestLinks> closest;
          if (known != found.end()) closest = known->second;
          take_closer(closest, {a, b, inside.hit(margins_.clearance(a, b))}, inside.point);
          found[{a, b}] = *closest;
          return false;
        });
        std::vector<ClosestLinks> all;
        for (const auto& [pair, closest] : found) all.push_back(closest);
        return all;
      },
      *hierarchy_);
}

std::vector<ClosestBody> RobotChecker::distances(Environment& environment, double margin) {
  check_margin(margin);
  const auto order = [](const auto& x) { return std::tuple(x.held, x.link, x.body); };
  std::vector<ClosestBody> found;
  for (const BodyPair& pair : body_pairs(environment, margin)) {
    const std::size_t before = found.size();
    ask(pair, environment, [&](auto& mine, auto& theirs, const auto& filter, const QueryOptions& options) {
      const std::span<const LinkId> links = mine.model().model().links(), others = theirs.model().model().links();
      const auto query = [&](auto& collector) { mine.query(theirs, collector, filter, options); };
      const bool has_radii = mine.matrix().has_radii() || theirs.matrix().has_radii();
      for (const auto& [links_of_hit, hit] : closest_of_pairs(engine_, links, others, margin, has_radii, query)) {
        const double more = detail::clearance_of(options.clearance, mine.model().group_of(hit.first));
        const Closeness n =
            measure(mine, theirs, hit, mine.matrix().sum(hit.first, theirs.matrix(), hit.second) + more);
        ClosestBody closest{links_of_hit.first, {},    pair.body_id, hit.first, hit.second,
                            n.distance,         n.gap, n.point1,     n.point2};
        if (pair.held != nullptr) {
          closest.link = pair.held->attachment->link;
          closest.held = pair.held_id;
        }
        found.push_back(closest);
      }
    });
    find_insides(pair, environment, [&](const BodyContact& contact, const Vec3& point) {
      const auto known = std::find_if(found.begin() + static_cast<std::ptrdiff_t>(before), found.end(),
                                      [&](const ClosestBody& x) { return order(x) == order(contact); });
      const ClosestBody inside = inside_of(contact, point);
      if (known == found.end()) {
        found.push_back(inside);
      } else if (is_closer(inside, *known)) {
        *known = inside;
      }
      return false;
    });
  }
  std::sort(found.begin(), found.end(), [&](const auto& x, const auto& y) { return order(x) < order(y); });
  return found;
}

}  // namespace hinge::robotics
