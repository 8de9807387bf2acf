// SPDX-License-Identifier: BSD-3-Clause
// ClosedSampler: random conformations whose cycles are closed: loops with both ends fixed, disulphides, cyclic
// backbones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/kinematics/closure_solver.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/sampler.hpp"

namespace hinge::molecular {

/// The result of one sample. If a start does not close, the next one is drawn from the same stream.
struct ClosedSample {
  /// One value per selected DOF, relative to the reference, rad or angstrom; empty: no start closed.
  std::vector<double> q;
  std::uint64_t unclosed = 0;  ///< starts that did not close

  /// True if a start closed.
  bool found() const noexcept { return !q.empty(); }
};

/// The starts of one sample: the first equals sample_configuration, the next continue its streams.
class HINGE_API StartStream {
 public:
  /// ranges: one per placed part. The selection holds the DOF of all placed parts. Throws ModelError if the number of
  /// ranges is wrong.
  StartStream(const Sampling& sampling, std::uint64_t index, const Molecule& molecule, const DofSelection& selection,
              std::span<const PlacementRange> ranges);
  /// Returns the next start, one value per selected DOF. All starts have the same placements.
  std::vector<double> next();

 private:
  Sampling sampling_;
  SampleStream turns_;
  std::vector<std::size_t> turning_;  // indices in a configuration
  std::vector<double> q_;
};

/// Sample `index` depends on the construction and (seed, index) alone: a start of StartStream that the solver moves
/// onto the closed set (every closure within 1e-9 angstrom, far below the decimals of a file). One per thread.
class HINGE_API ClosedSampler {
 public:
  /// Keeps all closures of the molecule, which has no placed parts. The molecule must outlive the sampler. Throws
  /// ModelError if most_tries is 0 or the selection is empty.
  ClosedSampler(const Molecule& molecule, const DofSelection& selection, const Sampling& sampling,
                std::uint64_t most_tries)
      : ClosedSampler(molecule, selection, sampling, most_tries, all_closures(molecule.model().tree()), {}) {}
  /// Keeps these closures (find_kept_closures), indices in the tree's. ranges: one per placed part. The molecule must
  /// outlive the sampler. Throws ModelError as above, and for bad ranges (sample_configuration).
  ClosedSampler(const Molecule& molecule, const DofSelection& selection, const Sampling& sampling,
                std::uint64_t most_tries, const std::vector<std::size_t>& closures,
                std::span<const PlacementRange> ranges);

  /// Returns the first closed conformation, from at most most_tries starts.
  ClosedSample sample(std::uint64_t index);

 private:
  const Molecule* molecule_;
  DofSelection selection_;
  ClosureSolver solver_;
  Sampling sampling_;
  std::vector<PlacementRange> ranges_;
  std::uint64_t most_tries_;
};

/// Returns those of the torsions (indices in Molecule::torsions()) that cannot leave the reference while all cycles
/// stay closed, for all coordinates that round to the given three decimals. Sorted. It may miss some.
HINGE_API std::vector<std::size_t> find_held_torsions(const Molecule& molecule, std::span<const std::size_t> torsions);
/// The same with only these closures kept, indices in the tree's.
HINGE_API std::vector<std::size_t> find_held_torsions(const Molecule& molecule, std::span<const std::size_t> torsions,
                                                      std::span<const std::size_t> closures);

}  // namespace hinge::molecular
