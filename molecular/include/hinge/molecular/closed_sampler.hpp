// SPDX-License-Identifier: BSD-3-Clause
// Random conformations whose cycles are closed: loops with both ends held, disulphides, cyclic backbones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/kinematics/closure_solver.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/sampler.hpp"

namespace hinge::molecular {

/// What became of one sample. A start that does not close is given up, and the next is drawn from the same stream.
struct ClosedSample {
  std::vector<double> q;       ///< turns from the reference, rad; empty when no start gave a sample
  std::uint64_t unclosed = 0;  ///< starts that did not close
  std::uint64_t refused = 0;   ///< closed conformations that were not accepted

  bool found() const noexcept { return !q.empty(); }
};

/// The starts of one sample: the first is what sample_configuration gives, the next go on in the same streams.
class StartStream {
 public:
  /// ModelError: as sample_configuration.
  StartStream(const Sampling& sampling, std::uint64_t index, const Molecule& molecule, const DofSelection& selection,
              std::span<const PlacementRange> ranges);
  /// New turns, and with `place` (as the first time) new placements.
  std::vector<double> next(bool place);

 private:
  Sampling sampling_;
  std::vector<PlacementRange> ranges_;
  SampleStream turns_;
  std::vector<SampleStream> places_;                 // by placed part
  std::vector<std::size_t> turning_;                 // positions in a configuration
  std::vector<std::array<std::size_t, 6>> placing_;  // by placed part
  std::vector<double> q_;
};

/// Sample `index` is a function of (seed, index): a start drawn as sample_configuration draws it, moved onto the closed
/// set by the solver (every closure within 1e-9 angstrom, far below what a file's decimals show). One per thread.
class ClosedSampler {
 public:
  /// Keeps all closures; no part is placed. ModelError: most_tries 0, no DOF.
  ClosedSampler(const Molecule& molecule, const DofSelection& selection, const Sampling& sampling,
                std::uint64_t most_tries)
      : ClosedSampler(molecule, selection, sampling, most_tries, all_closures(molecule.model().tree()), {}) {}
  /// Keeps `closures` (find_kept_closures), positions in the tree's. ranges: of the placed parts, which stay where a
  /// sample's first start put them until a closed conformation is not accepted. The molecule outlives the sampler.
  ClosedSampler(const Molecule& molecule, const DofSelection& selection, const Sampling& sampling,
                std::uint64_t most_tries, const std::vector<std::size_t>& closures,
                std::span<const PlacementRange> ranges);

  /// The first closed conformation for which accept(q) holds, of at most most_tries starts.
  template <class Accept>
  ClosedSample sample(std::uint64_t index, const Accept& accept) {
    StartStream stream(sampling_, index, *molecule_, selection_, ranges_);
    ClosedSample result;
    bool place = true;
    for (std::uint64_t k = 0; k < most_tries_; ++k) {
      std::vector<double> q = stream.next(place);
      place = false;
      if (!solver_.close(q)) {
        ++result.unclosed;
      } else if (!accept(std::span<const double>(q))) {
        ++result.refused;
        place = true;
      } else {
        result.q = std::move(q);
        break;
      }
    }
    return result;
  }
  ClosedSample sample(std::uint64_t index) {
    return sample(index, [](std::span<const double>) { return true; });
  }

 private:
  const Molecule* molecule_;
  DofSelection selection_;
  ClosureSolver solver_;
  Sampling sampling_;
  std::vector<PlacementRange> ranges_;
  std::uint64_t most_tries_;
};

/// Those of the torsions (positions in Molecule::torsions()) that cannot leave the reference while all cycles stay
/// closed, for any coordinates that three decimals could stand for (rigid_cycle_dofs).
std::vector<std::size_t> find_held_torsions(const Molecule& molecule, std::span<const std::size_t> torsions);
/// While these closures, positions in the tree's, stay closed.
std::vector<std::size_t> find_held_torsions(const Molecule& molecule, std::span<const std::size_t> torsions,
                                            std::span<const std::size_t> closures);

}  // namespace hinge::molecular
