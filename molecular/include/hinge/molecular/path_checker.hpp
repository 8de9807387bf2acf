// SPDX-License-Identifier: BSD-3-Clause
// PathChecker: tests straight paths of a molecule, by a proof for every state or by samples.
#pragma once

#include <functional>
#include <span>

#include "hinge/core/api.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/path/certified_path.hpp"
#include "hinge/path/path_answer.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge::molecular {

/// Tests straight paths in joint space with the clash rules of a Checker. Pairs of constant distance are left out, and
/// closures are not solved, as in Checker::check. from, to: one value per DOF of the checker's selection, rad or
/// angstrom, relative to the reference. Throws ConfigurationError for a wrong number of values or one that is not
/// finite. between: called before every segment or state; may throw to end the work. One per thread; copies share all
/// constant data.
class HINGE_API PathChecker {
 public:
  /// Takes the molecule's model, the selection and the rules from the checker; independent of it afterwards.
  explicit PathChecker(const Checker& checker);

  /// Proves the verdict for every state of the path. A segment no longer than smallest_step (a share of the path, > 0,
  /// otherwise ConfigurationError) is not divided.
  PathAnswer certify(std::span<const double> from, std::span<const double> to,
                     double smallest_step = smallest_path_step, const std::function<void()>& between = {});
  /// Tests states between which no DOF changes by more than `resolution` (rad or angstrom). Throws ConfigurationError
  /// unless it is finite, above 0, and large enough for at most 2^53 states.
  PathAnswer sample(std::span<const double> from, std::span<const double> to, double resolution,
                    const std::function<void()>& between = {});

 private:
  MolecularHierarchy<Simd> hierarchy_;
  CertifiedPath<Point, BondExclusions, TypedThresholds, Simd> certified_;
};

}  // namespace hinge::molecular
