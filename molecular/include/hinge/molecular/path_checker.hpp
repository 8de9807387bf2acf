// SPDX-License-Identifier: BSD-3-Clause
// PathChecker: straight paths of a molecule, proved free or looked at, state by state.
#pragma once

#include <span>

#include "hinge/engine/simd.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/path/certified_path.hpp"
#include "hinge/path/path_answer.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge::molecular {

/// Paths join turns from the reference, rad, one per DOF that the checker's selection frees; its rules decide, and as
/// in its verdicts pairs of constant distance have no part and closures are not solved. ConfigurationError as from
/// CertifiedPath::check and check_sampled. One per thread; copies share everything constant.
class PathChecker {
 public:
  explicit PathChecker(const Checker& checker);

  /// For every state between the two. A stretch, as a share of the path, is not cut any more when it is no longer than
  /// `smallest_step`.
  PathAnswer certify(std::span<const double> from, std::span<const double> to,
                     double smallest_step = smallest_path_step);
  /// At states no torsion of which is more than `resolution` (rad) from that of the next.
  PathAnswer sample(std::span<const double> from, std::span<const double> to, double resolution);

 private:
  MolecularHierarchy<Simd> hierarchy_;
  CertifiedPath<Point, BondExclusions, TypedThresholds, Simd> certified_;
};

}  // namespace hinge::molecular
