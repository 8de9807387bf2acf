// SPDX-License-Identifier: BSD-3-Clause
// Which closures of a molecule stay closed while torsions are free, and which are left open, and why.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/sampler.hpp"

namespace hinge::molecular {

struct KeptClosures {
  std::vector<std::size_t> closures;  ///< positions in KinematicTree::closures(), of those that free DOF can open
  std::vector<std::size_t> torsions;  ///< that are free: positions in Molecule::torsions()
  std::vector<std::size_t> held;      ///< that were to be free and cannot move while all of `closures` hold
  std::vector<std::string> notes;     ///< one for each closure that is left open: its name and why
};

/// Which closures, of ends of loops alone or of everything, and which torsions? All closures that a solver can keep:
/// not those that the placement of a part opens, which has its own range. `open`: left open anyhow (find_unclosable).
enum class Closures : std::uint8_t { of_loops, all };
KeptClosures find_kept_closures(const Molecule& molecule, std::span<const std::size_t> torsions, Closures which,
                                std::span<const std::size_t> open = {});

/// Positions, in the tree's closures, of those to leave open because random starts do not close: none when one of
/// sixteen does. Else the half of the failing closures that fail most often is given up, again and again until a start
/// closes. Ends of loops are never given up. A function of the sampling, the selection and the molecule.
std::vector<std::size_t> find_unclosable(const Molecule& molecule, const DofSelection& selection,
                                         const Sampling& sampling, std::span<const PlacementRange> ranges,
                                         std::span<const std::size_t> closures);

}  // namespace hinge::molecular
