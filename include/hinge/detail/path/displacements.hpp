// SPDX-License-Identifier: BSD-3-Clause
// Displacements: bounds of the displacement of rigid groups in a segment, relative to one group that is held fixed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/path/group_rates.hpp"
#include "hinge/detail/path/twist.hpp"

namespace hinge::detail {

/// A common motion of all groups changes no distance, so any group may be held. A group in the middle of a chain makes
/// the largest displacement small.
class Displacements {
 public:
  /// Chooses the group to hold for a path, from the speeds at one state of it.
  void begin(std::span<const GroupRate> groups);

  /// Bounds the displacement of any point of each group when the parameter changes by at most `half` from the middle
  /// that `groups` are set to. Rounding is included; scaled like `groups`. Returns the largest; groups without
  /// primitives do not count.
  double find(std::span<const GroupRate> groups, double half);
  /// The same for another half width around the same middle.
  double find_again(std::span<const GroupRate> groups, double half);
  std::span<const double> of_groups() const noexcept { return of_groups_; }

 private:
  struct Moving {
    Twist twist;
    Change change;
    double summed = 0.0;  // sum of angular speeds of the joints from the held group on
  };
  // A group other than the world is held only if that reduces the largest speed by this factor.
  static constexpr double worth_holding = 0.8;

  template <class Pass>
  void outward(std::span<const GroupRate> groups, const Pass& pass);
  std::pair<std::size_t, double> find_fastest(std::span<const GroupRate> groups);
  void spread(std::span<const GroupRate> groups, double half);
  double bound(std::span<const GroupRate> groups, double half);

  std::size_t held_ = 0;
  std::vector<Moving> moving_;  // per group
  std::vector<std::uint8_t> on_way_;
  std::vector<double> speeds_;  // per group with primitives: speed at the middle
  std::vector<double> of_groups_;
};

/// Calls pass(group behind the joint, group the joint belongs to), starting at the held group; each group comes after
/// the group before it on the path.
template <class Pass>
void Displacements::outward(std::span<const GroupRate> groups, const Pass& pass) {
  moving_.resize(groups.size());
  on_way_.assign(groups.size(), 0);
  moving_[held_] = {};
  on_way_[held_] = 1;
  for (std::size_t g = held_; g != 0; g = groups[g].parent) {
    moving_[groups[g].parent] = moving_[g];
    on_way_[groups[g].parent] = 1;
    pass(groups[g].parent, g);
  }
  for (std::size_t g = 1; g < groups.size(); ++g) {
    if (on_way_[g] != 0) continue;
    moving_[g] = moving_[groups[g].parent];
    pass(g, g);
  }
}

inline std::pair<std::size_t, double> Displacements::find_fastest(std::span<const GroupRate> groups) {
  outward(groups, [&](std::size_t to, std::size_t joint) {
    Twist& twist = moving_[to].twist;
    twist = to == joint ? twist + groups[joint].joint : twist - groups[joint].joint;
  });
  std::pair<std::size_t, double> fastest{0, 0.0};
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (const double s = groups[g].speed_bound(moving_[g].twist); groups[g].has_primitives && s > fastest.second)
      fastest = {g, s};
  return fastest;
}

inline void Displacements::begin(std::span<const GroupRate> groups) {
  held_ = 0;
  const auto [fastest, against_world] = find_fastest(groups);
  double passed = 0.0;
  std::size_t half_way = fastest;
  while (half_way != 0 && passed < 0.5 * groups[fastest].summed) {
    passed += groups[half_way].slides ? 0.0 : groups[half_way].speed;
    half_way = groups[half_way].parent;
  }
  if (half_way == 0) return;
  held_ = half_way;
  if (!(find_fastest(groups).second < worth_holding * against_world)) held_ = 0;
}

inline double Displacements::find(std::span<const GroupRate> groups, double half) {
  spread(groups, half);
  speeds_.resize(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (groups[g].has_primitives) speeds_[g] = groups[g].largest_speed(moving_[g].twist);
  return bound(groups, half);
}

inline double Displacements::find_again(std::span<const GroupRate> groups, double half) {
  spread(groups, half);
  return bound(groups, half);
}

/// Computes twists and changes of all groups.
inline void Displacements::spread(std::span<const GroupRate> groups, double half) {
  outward(groups, [&](std::size_t to, std::size_t joint) {
    const GroupRate& by = groups[joint];
    Moving& moving = moving_[to];
    const bool to_child = to == joint;
    // The vector between two reference points moves with the parent.
    if (to_child) moving.change.point += by.step * moving.change.unit();
    moving.twist = to_child ? moving.twist + by.joint : moving.twist - by.joint;
    if (!by.slides) moving.summed += by.speed;
    const double rounding = groups[to].rounding + groups[held_].rounding;
    pass_joint(by, half, norm(moving.twist.turn) + share_of_rounding * rounding * moving.summed, moving.change);
    if (!to_child) moving.change.point += by.step * moving.change.unit();
  });
}

inline double Displacements::bound(std::span<const GroupRate> groups, double half) {
  of_groups_.assign(groups.size(), 0.0);
  double largest = 0.0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const GroupRate& group = groups[g];
    if (!group.has_primitives || (held_ == 0 && group.stands)) continue;
    const Moving& moving = moving_[g];
    const double second = moving.change.point + moving.change.unit() * group.radius;
    const double turns = 1.0 + half * moving.summed;
    const double rounding = share_of_rounding * turns * turns * (group.rounding + groups[held_].rounding) *
                            (group.reach + groups[held_].reach);
    of_groups_[g] = (half * speeds_[g] + 0.5 * half * half * second) * bound_above + rounding;
    // Overflowing speeds may give NaN.
    if (!(of_groups_[g] >= 0.0)) of_groups_[g] = std::numeric_limits<double>::infinity();
    largest = std::max(largest, of_groups_[g]);
  }
  return largest;
}

}  // namespace hinge::detail
