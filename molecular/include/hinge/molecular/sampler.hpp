// SPDX-License-Identifier: BSD-3-Clause
// Random conformations of a selection: each depends on (seed, index) alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/molecular/molecule.hpp"

namespace hinge::molecular {

/// Distribution of torsions: uniform over the full turn, or Gaussian about the reference.
struct Sampling {
  std::uint64_t seed = 0;       ///< the same seed gives the same conformations on every machine
  std::optional<double> sigma;  ///< standard deviation, rad; nullopt: uniform in (-pi, pi]
};

/// Range of a placed part, relative to its reference: largest distance of its centre (angstrom, >= 0), and largest
/// angle of its rotation as a whole (rad, 0 ... pi).
struct PlacementRange {
  double distance = 0.0;  ///< angstrom
  double turn = 0.0;      ///< rad
};

/// Returns the next configuration of a stream: rotations relative to the reference (rad), dof_count values.
HINGE_API std::vector<double> draw_configuration(const Sampling& sampling, SampleStream& stream, std::size_t dof_count);

/// Returns sample `index`: rotations relative to the reference (rad), one per DOF in DOF order.
HINGE_API std::vector<double> sample_configuration(const Sampling& sampling, std::uint64_t index,
                                                   std::size_t dof_count);

/// The same with placed parts: one value per selected DOF. Torsions are drawn as above, independent of the placements.
/// Each placement is uniform in its range, independent of the torsions: the centre by volume, the rotation by the
/// invariant measure. ranges: one per placed part. Throws ModelError if their number is wrong or one is out of range.
HINGE_API std::vector<double> sample_configuration(const Sampling& sampling, std::uint64_t index,
                                                   const Molecule& molecule, const DofSelection& selection,
                                                   std::span<const PlacementRange> ranges);

/// Returns the values of PlacedPart::dofs: three in angstrom, three in rad.
HINGE_API std::array<double, 6> sample_placement(SampleStream& stream, const PlacementRange& range);

}  // namespace hinge::molecular
