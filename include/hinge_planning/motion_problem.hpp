// SPDX-License-Identifier: BSD-3-Clause
// MotionProblem: what a planner needs to know of a mechanism.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "hinge/core/philox.hpp"

namespace hinge::planning {

/// Configurations have one value per degree of freedom, rad or the model's length unit. Not thread-safe.
class MotionProblem {
 public:
  virtual ~MotionProblem() = default;

  /// Number of values of a configuration.
  virtual std::size_t dof_count() const = 0;
  /// A metric of configurations.
  virtual double distance(std::span<const double> a, std::span<const double> b) const = 0;
  /// An upper bound of the distance of two configurations that draw() may return.
  virtual double largest_distance() const = 0;
  /// Draws a configuration towards which a tree grows. It need not be free.
  virtual void draw(SampleStream& stream, std::span<double> q) = 0;
  /// Writes the configuration at `share` (0 to 1) of the motion from `from` to `to`.
  virtual void go(std::span<const double> from, std::span<const double> to, double share, std::span<double> q) {
    for (std::size_t k = 0; k < q.size(); ++k) q[k] = from[k] + share * (to[k] - from[k]);
  }
  /// Returns the configurations after `from` that the motion to `to` visits, with `to` as the last; the motion is
  /// straight from each to the next.
  virtual std::vector<std::vector<double>> steps(std::span<const double> /*from*/, std::span<const double> to) {
    return {std::vector<double>(to.begin(), to.end())};
  }
  /// True if the configuration is allowed and does not collide.
  virtual bool is_free(std::span<const double> q) = 0;
  /// True if every configuration of the motion is proved free.
  virtual bool is_motion_free(std::span<const double> from, std::span<const double> to) = 0;
};

}  // namespace hinge::planning
