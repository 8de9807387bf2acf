// SPDX-License-Identifier: BSD-3-Clause
// random_move: Gaussian changes of a few random DOF, a pure function of (seed, step) and the configuration.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/moves/dof_change.hpp"

namespace hinge {

/// Fills `changes` with `count` different DOF (all DOF if there are fewer), sorted by DOF. Each new value is the value
/// in q plus a normal step of standard deviation `sigma` (rad or model length unit). Every subset of that size is
/// equally likely (Floyd's sampling: Bentley, Floyd, "A sample of brilliance", CACM 30, 1987).
inline void random_move(std::uint64_t seed, std::uint64_t step, std::span<const double> q, std::size_t count,
                        double sigma, std::vector<DofChange>& changes) {
  SampleStream stream(seed, step);
  changes.clear();
  for (std::size_t last = q.size() - std::min(count, q.size()); last < q.size(); ++last) {
    const auto drawn = static_cast<std::size_t>(stream.uniform() * static_cast<double>(last + 1));
    const bool taken = std::any_of(changes.begin(), changes.end(), [&](const DofChange& c) { return c.dof == drawn; });
    changes.push_back({taken ? last : drawn, 0.0});
  }
  std::sort(changes.begin(), changes.end(), DofChange::by_dof);
  for (DofChange& change : changes) change.value = q[change.dof] + sigma * stream.normal();
}

}  // namespace hinge
