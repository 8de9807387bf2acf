// SPDX-License-Identifier: BSD-3-Clause
// Random conformations of a selection: each a pure function of (seed, index).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/molecular/molecule.hpp"

namespace hinge::molecular {

/// Uniform over the full turn, or Gaussian about the reference.
struct Sampling {
  std::uint64_t seed = 0;
  std::optional<double> sigma;  ///< rad; none: full range (-pi, pi]
};

/// How far a placed part goes from its reference: its centre, at most (angstrom), and the one turn that all its
/// rotation amounts to, at most (rad, 0 ... pi).
struct PlacementRange {
  double distance = 0.0;
  double turn = 0.0;
};

/// The next configuration of a stream: turns from the reference (rad), one per DOF.
std::vector<double> draw_configuration(const Sampling& sampling, SampleStream& stream, std::size_t dof_count);

/// Turns from the reference (rad) of sample `index`, one per DOF, in DOF order.
std::vector<double> sample_configuration(const Sampling& sampling, std::uint64_t index, std::size_t dof_count);

/// The same with placed parts: torsions as above, whatever is placed; each placement, whatever else is free, uniform in
/// its range: the centre in volume, the rotation by the invariant measure. ranges: one per placed part; ModelError:
/// another number of them, one that is no range.
std::vector<double> sample_configuration(const Sampling& sampling, std::uint64_t index, const Molecule& molecule,
                                         const DofSelection& selection, std::span<const PlacementRange> ranges);

/// Values of PlacedPart::dofs.
std::array<double, 6> sample_placement(SampleStream& stream, const PlacementRange& range);

}  // namespace hinge::molecular
