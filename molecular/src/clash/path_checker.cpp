// SPDX-License-Identifier: BSD-3-Clause
// Instantiates certified path queries for molecules, in this file only.
#include "hinge/molecular/path_checker.hpp"

#include "hinge/path/check_sampled.hpp"

namespace hinge::molecular {

PathChecker::PathChecker(const Checker& checker)
    : hierarchy_(checker.molecule().model(), checker.selection(), checker.exclusions(), checker.thresholds().matrix),
      certified_(hierarchy_) {}

PathAnswer PathChecker::certify(std::span<const double> from, std::span<const double> to, double smallest_step,
                                const std::function<void()>& between) {
  return certified_.check(from, to, smallest_step, between);
}

PathAnswer PathChecker::sample(std::span<const double> from, std::span<const double> to, double resolution,
                               const std::function<void()>& between) {
  return check_sampled(hierarchy_, from, to, resolution, between);
}

}  // namespace hinge::molecular
