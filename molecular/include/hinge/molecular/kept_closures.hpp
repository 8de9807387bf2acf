// SPDX-License-Identifier: BSD-3-Clause
// find_kept_closures: which closures of a molecule a solver keeps while torsions are free, which stay open, and why.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/sampler.hpp"

namespace hinge::molecular {

/// The result of find_kept_closures.
struct KeptClosures {
  std::vector<std::size_t> closures;  ///< closures to keep that free DOF can open, indices in KinematicTree::closures()
  std::vector<std::size_t> torsions;  ///< torsions that stay free, indices in Molecule::torsions()
  /// Given torsions that cannot move while the closures hold; empty if the molecule has loops.
  std::vector<std::size_t> held;
  std::vector<std::string> notes;  ///< one for each closure that stays open: its name and the reason
};

/// The closures to choose from: ends of loops, or all.
enum class Closures : std::uint8_t { of_loops, all };
/// Returns the closures to keep and the torsions that stay free. Closures that the placement of a part opens are never
/// kept: the part has its own range. torsions: indices in Molecule::torsions(). open: further closures to leave open
/// (find_unclosable), indices in the tree's.
HINGE_API KeptClosures find_kept_closures(const Molecule& molecule, std::span<const std::size_t> torsions,
                                          Closures which, std::span<const std::size_t> open = {});

/// Returns the closures to leave open because random starts do not close, indices in the tree's, sorted; empty if one
/// of sixteen starts closes. Otherwise the half of the failing closures that fails most often is given up, repeatedly,
/// until a start closes. Ends of loops are never given up. The result depends on the arguments alone.
HINGE_API std::vector<std::size_t> find_unclosable(const Molecule& molecule, const DofSelection& selection,
                                                   const Sampling& sampling, std::span<const PlacementRange> ranges,
                                                   std::span<const std::size_t> closures);

}  // namespace hinge::molecular
