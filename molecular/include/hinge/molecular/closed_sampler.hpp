// SPDX-License-Identifier: BSD-3-Clause
// Random conformations whose cycles are closed: loops with both ends held, disulphides, cyclic backbones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
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

/// Sample `index` is a function of (seed, index): a start drawn as sample_configuration draws it, moved onto the closed
/// set by the solver (every closure within 1e-9 angstrom, far below what a file's decimals show). One per thread.
class ClosedSampler {
 public:
  /// ModelError: most_tries 0.
  ClosedSampler(const Molecule& molecule, const DofSelection& selection, const Sampling& sampling,
                std::uint64_t most_tries);

  /// The first closed conformation for which accept(q) holds, of at most most_tries starts.
  template <class Accept>
  ClosedSample sample(std::uint64_t index, const Accept& accept) {
    SampleStream stream(sampling_.seed, index);
    ClosedSample result;
    for (std::uint64_t k = 0; k < most_tries_; ++k) {
      std::vector<double> q = draw_configuration(sampling_, stream, dof_count_);
      if (!solver_.close(q))
        ++result.unclosed;
      else if (!accept(std::span<const double>(q)))
        ++result.refused;
      else {
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
  ClosureSolver solver_;
  Sampling sampling_;
  std::size_t dof_count_;
  std::uint64_t most_tries_;
};

/// Those of the torsions (positions in Molecule::torsions()) that cannot leave the reference while all cycles stay
/// closed, for any coordinates that three decimals could stand for (rigid_cycle_dofs).
std::vector<std::size_t> find_held_torsions(const Molecule& molecule, std::span<const std::size_t> torsions);

}  // namespace hinge::molecular
