// SPDX-License-Identifier: BSD-3-Clause
// NearLinks: what is near of two links, and how near it can come: bodies of many primitives are proved apart as wholes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/motion/group_rates.hpp"
#include "hinge/motion/path_segments.hpp"
#include "hinge/motion/relative_motion.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge {

/// How much closer anything in two groups can come in a segment; scaled as they are.
inline double approach(const RelativeMotion& motion, const GroupRate& a, const GroupRate& b, double half) noexcept {
  const double first_radius = norm(Vec3(motion.first_point - a.centre)) + a.extent;
  const double second_radius = norm(Vec3(motion.second_point - b.centre)) + b.extent;
  const double speed = a.largest_speed(motion.first) + b.largest_speed(motion.second);
  const double second = motion.points + motion.first_unit * first_radius + motion.second_unit * second_radius;
  return (half * speed + 0.5 * half * half * second) * bound_above + motion.rounding;
}

/// The collector of the pairs of two links with d - M < margin, up to a number of them.
class NearLinks {
 public:
  static constexpr bool ranks = false;
  /// links: of every primitive. `found` is cleared.
  NearLinks(std::span<const LinkId> links, const PathPair& pair, double margin, std::size_t most,
            std::vector<PathPair>& found) noexcept
      : links_(links),
        first_(links[index(pair.first)]),
        second_(links[index(pair.second)]),
        margin_(margin),
        most_(most),
        found_(found) {
    found_.clear();
  }
  bool wants(LinkId a, LinkId b) const noexcept {
    return (a == first_ && b == second_) || (a == second_ && b == first_);
  }
  void add(const Hit& hit) {
    if (wants(links_[index(hit.first)], links_[index(hit.second)])) found_.push_back({hit.first, hit.second});
  }
  double cutoff() const noexcept { return margin_; }
  bool done() const noexcept { return found_.size() > most_; }

 private:
  std::span<const LinkId> links_;
  LinkId first_, second_;
  double margin_;
  std::size_t most_;
  std::vector<PathPair>& found_;
};

static_assert(Collector<NearLinks> && RefusesLinks<NearLinks>);

}  // namespace hinge
