// SPDX-License-Identifier: BSD-3-Clause
// Walker: a Monte Carlo walk of a molecule by collision-free moves of its torsions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge::molecular {

/// Options of a Walker.
struct WalkOptions {
  std::vector<std::size_t> closures{};   ///< closures to keep (find_kept_closures), indices in the tree's
  std::size_t changes = 1;               ///< torsions that a step draws, at least 1, at most the number of free ones
  double sigma = std::numbers::pi / 60;  ///< standard deviation of a drawn change, rad, above 0, at most 1e9
  std::uint64_t seed = 1;                ///< of the random changes
  std::vector<double> start{};           ///< first conformation: one value per selected DOF, rad; empty: the reference
};

/// Work of a walk.
struct WalkCounts {
  std::uint64_t steps = 0;         ///< steps made
  std::uint64_t accepted = 0;      ///< steps that changed the conformation
  std::uint64_t unclosed = 0;      ///< rejected steps whose cycles did not close; the other rejected steps collided
  std::uint64_t full_queries = 0;  ///< steps that were answered by a query of the whole molecule (MoveChecker)
};

/// Each step draws a Gaussian change of a few free torsions (random_move). If these are in closed cycles, the smallest
/// change of the other torsions closes the cycles (MoveCloser). The step is accepted if no pair of atoms collides after
/// it; otherwise the conformation stays. Steps that close cycles are not symmetric, so such a walk does not visit all
/// free conformations equally often. Step k is a function of (seed, k) and the conformation before it. One per thread.
class HINGE_API Walker {
 public:
  /// Tests the pairs of the checker, with the SIMD engine; the checker is not kept. Throws ModelError if the molecule
  /// has placed parts, no torsion is free, a closure does not exist, or changes or sigma is out of range;
  /// ConfigurationError for a bad start (Checker::check).
  explicit Walker(const Checker& checker, const WalkOptions& options = {});
  Walker(Walker&&) noexcept;             ///< leaves the source without a walk
  Walker& operator=(Walker&&) noexcept;  ///< leaves the source without a walk
  ~Walker();

  /// Makes the next step. Returns true if it is accepted.
  bool step();

  /// The conformation: one value per selected DOF, rad. Valid until the next step.
  std::span<const double> configuration() const noexcept;
  /// The coordinates of all atoms, angstrom.
  std::vector<Vec3> positions();
  /// The pairs that collide, sorted: none, unless the start collides and no step has been accepted.
  std::vector<Hit> collisions();
  /// Work so far.
  WalkCounts counts() const noexcept;

 private:
  struct Walk;
  std::unique_ptr<Walk> walk_;
};

}  // namespace hinge::molecular
