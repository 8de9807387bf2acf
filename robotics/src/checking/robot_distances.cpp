// SPDX-License-Identifier: BSD-3-Clause
// Computes the closest points of every pair of links, or of a link and a body, within a margin.
#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
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
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/robot_checker.hpp"

namespace hinge::robotics {

namespace {

using LinkPair = std::pair<LinkId, LinkId>;

/// Collects for every pair of links within the margin the pair of triangles with the smallest d - M. If no triangle has
/// a radius, a contact ends the search of its pair of links, because no pair of triangles is closer.
class ClosestOfPairs {
 public:
  static constexpr bool ranks = false;
  /// For queries of one robot.
  ClosestOfPairs(std::span<const LinkId> links, double margin, bool has_radii)
      : ClosestOfPairs(links, links, margin, has_radii) {
    between_ = false;
  }
  /// For queries between two models.
  ClosestOfPairs(std::span<const LinkId> links, std::span<const LinkId> other_links, double margin, bool has_radii)
      : links_(links), other_links_(other_links), margin_(margin), has_radii_(has_radii) {}
  void add(const Hit& hit) {
    const auto [known, is_new] =
        best_.try_emplace(pair(links_[index(hit.first)], other_links_[index(hit.second)]), hit);
    const auto key = [](const Hit& h) { return std::tuple(h.gap(), h.first, h.second); };
    if (key(hit) < key(known->second)) known->second = hit;
  }
  bool wants(LinkId a, LinkId b) const noexcept {
    if (has_radii_) return true;
    const auto known = best_.find(pair(a, b));
    return known == best_.end() || known->second.distance > 0.0;
  }
  double cutoff() const noexcept { return margin_; }
  double smallest(LinkId a, LinkId b) const noexcept {
    const auto known = best_.find(pair(a, b));
    return known == best_.end() ? std::numeric_limits<double>::infinity() : known->second.gap();
  }
  bool done() const noexcept { return false; }
  const std::map<LinkPair, Hit>& best() const noexcept { return best_; }

 private:
  LinkPair pair(LinkId a, LinkId b) const noexcept {
    // Pairs within one robot have no order.
    return between_ ? LinkPair(a, b) : LinkPair(std::minmax(a, b));
  }

  std::span<const LinkId> links_, other_links_;
  double margin_;
  bool has_radii_, between_ = true;
  std::map<LinkPair, Hit> best_;
};

static_assert(RefusesLinks<ClosestOfPairs> && KeepsSmallestOfLinks<ClosestOfPairs>);

}  // namespace

std::vector<ClosestLinks> RobotChecker::surfaces_nearby(LinkId link, double margin) {
  const std::span<const LinkId> links = robot_->model().links();
  return std::visit(
      [&](auto& hierarchy) {
        // Rounding differs in this frame: enlarge the margin to keep the pairs that were within it.
        const double wider = margin * (1.0 + 0x1p-20) + 0x1p-20;
        std::vector<ClosestLinks> all;
        ClosestOfPairs found(links, wider, margins_.has_radii());
        hierarchy.self_query(found);
        for (const auto& [pair, hit] : found.best())
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
        std::map<LinkPair, ClosestLinks> found;
        std::set<LinkId> far;  // first links of the pairs far from the origin
        ClosestOfPairs surfaces(links, margin, margins_.has_radii());
        hierarchy.self_query(surfaces);
        for (const auto& [pair, hit] : surfaces.best()) {
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
      ClosestOfPairs surfaces(links, others, margin, mine.matrix().has_radii() || theirs.matrix().has_radii());
      mine.query(theirs, surfaces, filter, options);
      for (const auto& [links_of_hit, hit] : surfaces.best()) {
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
