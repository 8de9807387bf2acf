// SPDX-License-Identifier: BSD-3-Clause
// The closures of a molecule: what its spanning tree leaves out.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hinge/kinematics/kinematic_tree.hpp"
#include "hinge/molecular/held_placement.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/molecular/torsions.hpp"

namespace hinge::molecular {

struct OpenCycles {
  std::vector<std::uint32_t> loop_ends;  ///< torsions at which loops were cut
  std::vector<std::uint32_t> torsions;   ///< others that would close a cycle
  std::vector<Bond> bonds;               ///< that do not turn
  bool hydrogen_bonds = false;           ///< close those of the backbone too
  std::span<const HeldPlacement> held;   ///< what torsions lie between
};

struct ClosedCycle {
  Closure closure;
  std::array<std::uint32_t, 2> atoms{};  ///< that it joins
};

/// link_of_atom: the link each atom's rigid fragment is. Adds a note for each closure. What lies in one fragment is
/// left out: nothing can open it.
std::vector<ClosedCycle> close_cycles(const Structure& structure, std::span<const Torsion> torsions,
                                      const OpenCycles& cycles, std::span<const std::uint32_t> link_of_atom,
                                      std::vector<std::string>& notes);

}  // namespace hinge::molecular
