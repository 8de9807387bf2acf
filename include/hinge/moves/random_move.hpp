// SPDX-License-Identifier: BSD-3-Clause
// random_move: Gaussian changes of a few DOF chosen at random, a pure function of (seed, step) and the configuration.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/moves/dof_change.hpp"

namespace hinge {

/// `count` different DOF, or all when there are fewer, each from its value in q by a normal step of deviation `sigma`
/// (rad or model length unit), into `changes`, by DOF. Any subset of that size is as likely (Floyd's sampling, Bentley,
/// Floyd, "A sample of brilliance", CACM 30, 1987).
inline void random_move(std::uint64_t seed, std::uint64_t step, std::span<const double> q, std::size_t count,
                        double sigma, std::vector<DofChange>& changes) {
  SampleStream stream(seed, step);
  changes.clear();
  for (std::size_t last = q.size() - std::min(count, q.size()); last < q.size(); ++last) {
    const auto drawn = static_cast<std::size_t>(stream.uniform() * static_cast<double>(last + 1));
    const bool taken = std::ranges::any_of(changes, [&](const DofChange& c) { return c.dof == drawn; });
    changes.push_back({taken ? last : drawn, 0.0});
  }
  std::ranges::sort(changes, {}, &DofChange::dof);
  for (DofChange& change : changes) change.value = q[change.dof] + sigma * stream.normal();
}

}  // namespace hinge
