// SPDX-License-Identifier: BSD-3-Clause
// StraightPath: the segment between two configurations, validated once, and its states.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"

namespace hinge {

/// The path q(t) = q0 + t (q1 - q0), 0 <= t <= 1; values in rad or model length unit. It copies both ends.
class StraightPath {
 public:
  /// from, to: dof_count values each. Throws ConfigurationError if a length differs, or if a value or a difference of
  /// two values is not finite.
  StraightPath(std::span<const double> from, std::span<const double> to, std::size_t dof_count)
      : from_(from.begin(), from.end()), to_(to.begin(), to.end()) {
    for (const auto& [end, what] : {std::pair{from, "start"}, std::pair{to, "end"}}) {
      if (end.size() != dof_count)
        throw ConfigurationError(std::string(what) + " of the path has " + std::to_string(end.size()) +
                                 " values, expected " + std::to_string(dof_count));
      for (std::size_t k = 0; k < end.size(); ++k)
        if (!is_finite(end[k]))
          throw ConfigurationError(std::string(what) + " of the path: value " + std::to_string(k) + " is " +
                                   number_text(end[k]) + ", expected a finite number");
    }
    rate_.reserve(dof_count);
    for (std::size_t k = 0; k < dof_count; ++k) {
      rate_.push_back(to[k] - from[k]);
      if (!is_finite(rate_[k]))
        throw ConfigurationError("the path takes value " + std::to_string(k) + " from " + number_text(from[k]) +
                                 " to " + number_text(to[k]) + ", expected a difference that is finite");
    }
  }

  /// The start q0: dof_count values. This span and the next two are valid for the life of the path.
  std::span<const double> from() const noexcept { return from_; }
  /// The end q1: dof_count values.
  std::span<const double> to() const noexcept { return to_; }
  /// The difference q1 - q0, rounded: dof_count values.
  std::span<const double> rate() const noexcept { return rate_; }

  /// Writes the state at t into q, rounded. The state is exactly q0 at t = 0, q1 at t = 1, and both where q0 = q1.
  void at(double t, std::vector<double>& q) const {
    q.resize(rate_.size());
    if (t == 1.0) {
      q = to_;
      return;
    }
    for (std::size_t k = 0; k < q.size(); ++k) q[k] = from_[k] + t * rate_[k];
  }

 private:
  std::vector<double> from_, to_, rate_;
};

/// Throws ConfigurationError unless the smallest step of a certified path, a share of the path, is above 0.
inline void check_smallest_step(double smallest_step) {
  if (!(smallest_step > 0.0))
    throw ConfigurationError("smallest step " + number_text(smallest_step) + ": expected a share above 0");
}

}  // namespace hinge
