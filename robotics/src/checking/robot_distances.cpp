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

/// Collects hits of one pair of links with d - M below a bound: any one of them, or the first in the order of
/// ClosestOfPairs.
class HitsOfPair {
 public:
  static constexpr bool ranks = false;
  HitsOfPair(std::span<const LinkId> links, std::span<const LinkId> other_links, const LinkPair& pair, double below,
             bool any)
      : links_(links), other_links_(other_links), pair_(pair), below_(below), any_(any) {}
  void add(const Hit& hit) {
    if (!wants(links_[index(hit.first)], other_links_[index(hit.second)])) return;
    const auto key = [](const Hit& h) { return std::tuple(h.gap(), h.first, h.second); };
    if (!best_ || key(hit) < key(*best_)) best_ = hit;
  }
  bool wants(LinkId a, LinkId b) const noexcept {
    return (a == pair_.first && b == pair_.second) ||
           (links_.data() == other_links_.data() && b == pair_.first && a == pair_.second);
  }
  double cutoff() const noexcept { return below_; }
  bool done() const noexcept { return any_ && best_; }
  const std::optional<Hit>& best() const noexcept { return best_; }

 private:
  std::span<const LinkId> links_, other_links_;
  LinkPair pair_;
  double below_;
  bool any_;
  std::optional<Hit> best_;
};

static_assert(RefusesLinks<HitsOfPair>);

/// Returns for every pair of links within the margin (m) the hit with the smallest gap. query(collector) runs the
/// engine. Fine meshes have millions of pairs of triangles within a margin. The simd engine skips links that the
/// collector does not want, so it is queried pair by pair, and the bound on the gap is bisected.
template <class Query>
std::map<LinkPair, Hit> closest_of_pairs(const std::string& engine, std::span<const LinkId> links,
                                         std::span<const LinkId> other_links, double margin, const Query& query) {
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
    const LinkPair pair{links[index(first.first)], other_links[index(first.second)]};
    const auto ask = [&](double below, bool any) {
      HitsOfPair hits(links, other_links, pair, below, any);
      query(hits);
      return hits.best();
    };
    // Invariant: the smallest gap is at least `low` and at most `high`, or negative.
    constexpr double narrow = 0x1p-6;
    constexpr int most_halvings = 60;
    double low = 0.0, high = std::max(first.gap(), 0.0);
    for (int k = 0; k < most_halvings && high - low > narrow * high; ++k) {
      const double middle = low + (high - low) / 2;
      if (const auto nearer = ask(middle, true))
        high = std::max(nearer->gap(), 0.0);
      else
        low = middle;
    }
    // Enlarge the bound slightly, so that rounding excludes no pair of triangles with an equal gap.
    best.emplace(pair, ask(high > 0.0 ? high * (1.0 + 0x1p-30) : 0.0, false).value_or(first));
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
        for (const auto& [pair, hit] : closest_of_pairs(engine_, links, links, wider, ask))
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
        for (const auto& [pair, hit] : closest_of_pairs(engine_, links, links, margin, ask)) {
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
      for (const auto& [links_of_hit, hit] : closest_of_pairs(engine_, links, others, margin, query)) {
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
