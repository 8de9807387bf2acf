// SPDX-License-Identifier: BSD-3-Clause
// Makes the closures of a molecule: constraints for the torsions and bonds that the spanning tree leaves out.
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

/// The cycles that the spanning tree leaves open. Torsions are indices into the list given to close_cycles.
struct OpenCycles {
  std::vector<std::uint32_t> loop_ends;  ///< torsions at which loops are cut
  std::vector<std::uint32_t> torsions;   ///< other torsions that would close a cycle
  std::vector<Bond> bonds;               ///< bonds that would close a cycle and are not torsions
  bool hydrogen_bonds = false;           ///< also close hydrogen bonds of the backbone
  std::span<const HeldPlacement> held;   ///< relative placements to hold
};

/// A closure and the bond or contact that it stands for.
struct ClosedCycle {
  Closure closure;
  std::array<std::uint32_t, 2> atoms{};  ///< the two atoms that the closure joins
};

/// Returns the closures of `cycles` and adds one note per closure. link_of_atom: per atom, the link of its rigid
/// fragment. Closures within one link are left out, since nothing can open them.
std::vector<ClosedCycle> close_cycles(const Structure& structure, std::span<const Torsion> torsions,
                                      const OpenCycles& cycles, std::span<const std::uint32_t> link_of_atom,
                                      std::vector<std::string>& notes);

}  // namespace hinge::molecular
