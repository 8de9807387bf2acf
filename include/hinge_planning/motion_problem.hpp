// SPDX-License-Identifier: BSD-3-Clause
// MotionProblem: what a planner needs to know of a mechanism.
#pragma once

#include <bit>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "hinge/core/philox.hpp"

namespace hinge::planning {

/// Writes the configuration at `share` (0 to 1) of the straight motion from `from` to `to`.
inline void go_straight(std::span<const double> from, std::span<const double> to, double share, std::span<double> q) {
  for (std::size_t k = 0; k < q.size(); ++k) q[k] = from[k] + share * (to[k] - from[k]);
}

/// Tests `count` configurations of the straight motion, all but the start. The end comes first, then the middle, then
/// the middles of the halves: so a collision is found early. Returns false if is_free(q) does.
template <class IsFree>
bool test_along(std::span<const double> from, std::span<const double> to, std::size_t count, const IsFree& is_free) {
  if (!is_free(to)) return false;
  std::vector<double> q(from.size());
  for (std::size_t part = std::bit_ceil(count); part > 1; part /= 2)
    for (std::size_t k = part / 2; k < count; k += part) {
      go_straight(from, to, static_cast<double>(k) / static_cast<double>(count), q);
      if (!is_free(q)) return false;
    }
  return true;
}

/// Configurations have one value per degree of freedom, rad or the model's length unit. The functions are called by one
/// thread.
struct MotionProblem {
  std::size_t dof_count = 0;      ///< number of values of a configuration
  double largest_distance = 0.0;  ///< an upper bound of the distance of two configurations that draw() may return
  /// A metric of configurations.
  std::function<double(std::span<const double> a, std::span<const double> b)> distance;
  /// Draws a configuration towards which a tree grows. It need not be free.
  std::function<void(SampleStream& stream, std::span<double> q)> draw;
  /// True if the configuration is allowed and does not collide.
  std::function<bool(std::span<const double> q)> is_free;
  /// True if every configuration of the motion is proved free. It is also asked after the search was stopped, to prove
  /// what was found until then.
  std::function<bool(std::span<const double> from, std::span<const double> to)> is_motion_free;
  /// False if some configuration of the motion is not free; true proves nothing. It is asked first, because it costs
  /// less than is_motion_free. Empty: there is no such test.
  std::function<bool(std::span<const double> from, std::span<const double> to)> seems_free = {};
  /// Writes the configuration at `share` (0 to 1) of the motion from `from` to `to`.
  std::function<void(std::span<const double> from, std::span<const double> to, double share, std::span<double> q)> go =
      go_straight;
  /// Returns the configurations after `from` that the motion to `to` visits, with its end as the last; the motion is
  /// straight from each to the next.
  std::function<std::vector<std::vector<double>>(std::span<const double> from, std::span<const double> to)> steps =
      [](std::span<const double>, std::span<const double> to) {
        return std::vector<std::vector<double>>{std::vector<double>(to.begin(), to.end())};
      };
};

}  // namespace hinge::planning
