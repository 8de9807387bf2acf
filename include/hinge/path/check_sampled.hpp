// SPDX-License-Identifier: BSD-3-Clause
// check_sampled: tests many states along a straight path. It proves nothing about the states in between.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/path/path_answer.hpp"
#include "hinge/path/straight_path.hpp"
#include "hinge/query/collectors.hpp"

namespace hinge {

/// Returns the number of steps of equal length that sample the path, so that no value changes by more than `resolution`
/// (rad or model length unit) in a step; at least 1. Throws ConfigurationError if the resolution is not finite, not
/// above 0, or needs more than 2^53 states.
inline std::uint64_t count_steps(const StraightPath& path, double resolution) {
  if (!is_finite(resolution) || !(resolution > 0.0))
    throw ConfigurationError("resolution " + number_text(resolution) + ": expected a finite number above 0");
  double largest = 0.0;
  for (const double rate : path.rate()) largest = std::max(largest, std::abs(rate));
  const double wanted = std::ceil(largest / resolution);
  if (!(wanted <= 0x1p53))
    throw ConfigurationError("resolution " + number_text(resolution) + ": a path of " + number_text(largest) +
                             " takes more than 2^53 states");
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(wanted));
}

/// Tests both ends and evenly spaced states between them, so that no value changes by more than `resolution` (rad or
/// model length unit) from one state to the next. The states are tested in order of bisection. The hierarchy is left at
/// the last tested state. between: called before every state; may throw to end the work. Throws ConfigurationError for
/// a bad path (see StraightPath), and for a resolution that is not finite, not above 0, or needs more than 2^53 states.
template <class H>
PathAnswer check_sampled(H& hierarchy, std::span<const double> from, std::span<const double> to, double resolution,
                         const std::function<void()>& between = {}) {
  const StraightPath path(from, to, hierarchy.dof_count());
  const std::uint64_t steps = count_steps(path, resolution);
  const bool moves = std::any_of(path.rate().begin(), path.rate().end(), [](double rate) { return rate != 0.0; });

  PathAnswer answer;
  std::vector<double> q;
  const auto collides = [&](double t) {
    if (between) between();
    path.at(t, q);
    hierarchy.update(q);
    ++answer.counts.configurations;
    AnyHit any;
    hierarchy.self_query(any);
    if (!any.done()) return false;
    answer.verdict = PathVerdict::colliding;
    answer.parameter = t;
    answer.configuration = q;
    answer.hit = any.hit();
    return true;
  };
  if (collides(0.0) || (moves && collides(1.0))) return answer;
  for (std::uint64_t stride = std::bit_ceil(steps); stride > 1; stride /= 2)
    for (std::uint64_t k = stride / 2; k < steps; k += stride)
      if (collides(static_cast<double>(k) / static_cast<double>(steps))) return answer;
  answer.verdict = PathVerdict::free;
  answer.counts.segments = steps;
  return answer;
}

}  // namespace hinge
