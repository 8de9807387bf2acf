// SPDX-License-Identifier: BSD-3-Clause
// Referee: compares answers. If two differ, it finds the links that cause it and their distance.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/primitive/triangle.hpp"
#include "oracle/fcl_robots.hpp"
#include "robots/robot_contestant.hpp"
#include "robots/subject.hpp"

namespace hinge::bench {

/// m. Both sides round when they place meshes (1e-16 of coordinates of some metres), and FCL in part compares with
/// 1e-12 of the size of triangles. So either answer is accepted for links this close to touching. Far below any
/// manufacturing tolerance.
inline constexpr double touching = 1e-9;

/// Counts differences between Hinge and other contestants on one robot.
class Referee {
 public:
  using Fcl = FclPeer<oracle::FclBuild::debian>;
  Referee(const Subject& subject, HingeRobot& hinge, const Fcl& fcl) : subject_(subject), hinge_(hinge), fcl_(fcl) {}

  int differences() const noexcept { return differences_; }
  int touching_count() const noexcept { return touching_; }

  void compare(RobotQuery query, std::size_t posture, const RobotAnswer& hinge, RobotAnswer other,
               const std::string& who) {
    std::sort(other.pairs.begin(), other.pairs.end());
    oracle::Pairs own = hinge.pairs;
    std::sort(own.begin(), own.end());
    if (query == RobotQuery::distance) {
      if (!(std::abs(hinge.distance - other.distance) <= touching))
        report(query, posture, who, "distances", hinge.distance, other.distance);
    } else if (query == RobotQuery::environment) {
      if (hinge.hit != other.hit) settle_environment(posture, who);
    } else if (hinge.hit != other.hit || own != other.pairs) {
      settle_pairs(query, posture, who);
    }
  }

 private:
  void report(RobotQuery query, std::size_t posture, const std::string& who, const char* what, double a, double b) {
    ++differences_;
    std::printf("DIFFERENCE %s %s posture %zu: %s, hinge %.17g, %s %.17g\n", subject_.name().c_str(), name(query),
                posture, what, a, who.c_str(), b);
  }

  /// Handles links that only one side reports in contact. `gap`: their distance, found by the side that says they are
  /// apart.
  void judge(RobotQuery query, std::size_t posture, const std::string& who, const std::string& what, bool hinge_hits,
             double gap) {
    if (!(gap <= touching)) return report(query, posture, who, what.c_str(), hinge_hits ? 1 : 0, hinge_hits ? 0 : 1);
    ++touching_;
    std::printf("touching %s %s posture %zu: %s, hinge %s, %s %s, distance %.3g m\n", subject_.name().c_str(),
                name(query), posture, what.c_str(), hinge_hits ? "yes" : "no", who.c_str(), hinge_hits ? "no" : "yes",
                gap);
  }

  void settle_pairs(RobotQuery query, std::size_t posture, const std::string& who) {
    RobotAnswer mine, theirs;
    hinge_.ask(posture, RobotQuery::all, mine);
    fcl_.robot->take(posture);
    fcl_.robot->all(oracle::FclManner::loop, theirs.pairs);
    std::sort(mine.pairs.begin(), mine.pairs.end());
    std::sort(theirs.pairs.begin(), theirs.pairs.end());
    oracle::Pairs differing;
    std::set_symmetric_difference(mine.pairs.begin(), mine.pairs.end(), theirs.pairs.begin(), theirs.pairs.end(),
                                  std::back_inserter(differing));
    // The other side is another build or another query, so this comparison cannot show the cause.
    if (differing.empty()) report(query, posture, who, "no pair of links differs", mine.pairs.size() > 0, 0);
    const auto placed = hinge_.robot().placed();
    for (const auto& [i, j] : differing) {
      const bool hit = std::binary_search(mine.pairs.begin(), mine.pairs.end(), std::pair(i, j));
      judge(query, posture, who, link(i) + " and " + link(j), hit,
            hit ? fcl_.robot->distance(i, j) : nearest(of_link(placed, i), of_link(placed, j)));
    }
  }

  void settle_environment(std::size_t posture, const std::string& who) {
    RobotAnswer answer;
    hinge_.ask(posture, RobotQuery::environment, answer);
    fcl_.robot->take(posture);
    std::set<std::size_t> mine;
    const std::span<const LinkId> links = subject_.robot().model().links();
    for (const Hit& hit : hinge_.robot().collisions(hinge_.scene())) mine.insert(index(links[index(hit.first)]));
    bool any = false;
    for (std::size_t l = 0; l < subject_.meshes().size(); ++l) {
      if (subject_.meshes()[l].empty()) continue;
      const bool hit = mine.contains(l);
      if (hit == fcl_.robot->hits(*fcl_.scene, l)) continue;
      any = true;
      judge(RobotQuery::environment, posture, who, link(l), hit,
            hit ? fcl_.robot->distance(*fcl_.scene, l)
                : nearest(of_link(hinge_.robot().placed(), l), hinge_.scene().placed()));
    }
    if (!any) report(RobotQuery::environment, posture, who, "no link differs", !mine.empty(), 0);
  }

  const std::string& link(std::size_t l) const { return subject_.robot().link_name(id<LinkId>(l)); }
  /// The triangles of link l; triangles are ordered by link.
  std::span<const Triangle> of_link(std::span<const Triangle> placed, std::size_t l) const {
    const std::span<const LinkId> links = subject_.robot().model().links();
    const auto [first, last] = std::equal_range(links.begin(), links.end(), id<LinkId>(l));
    return placed.subspan(static_cast<std::size_t>(first - links.begin()), static_cast<std::size_t>(last - first));
  }

  /// The distance if it is at most `touching`, otherwise infinity.
  static double nearest(std::span<const Triangle> a, std::span<const Triangle> b) {
    Aabb around;
    for (const Triangle& t : a) around.extend(t.bounds());
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : b) {
      if (!near(around, t.bounds())) continue;
      for (const Triangle& s : a)
        if (near(s.bounds(), t.bounds())) least = std::min(least, std::sqrt(squared_distance(s, t)));
    }
    return least <= touching ? least : std::numeric_limits<double>::infinity();
  }
  static bool near(const Aabb& a, const Aabb& b) { return overlap(a.inflated(2 * touching), b); }

  const Subject& subject_;
  HingeRobot& hinge_;
  const Fcl& fcl_;
  int differences_ = 0;
  int touching_ = 0;
};

}  // namespace hinge::bench
