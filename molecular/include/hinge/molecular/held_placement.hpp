// SPDX-License-Identifier: BSD-3-Clause
// HeldPlacement: two parts of a molecule that torsions lie between and that keep their mutual placement all the same.
#pragma once

#include <array>
#include <cstdint>

namespace hinge::molecular {

/// All six degrees of freedom between the rigid fragments of two atoms are held as they are in model 0. points: atoms
/// anywhere, not all in one plane, where the two are compared; what is left open is measured there.
struct HeldPlacement {
  std::array<std::uint32_t, 2> atoms{};
  std::array<std::uint32_t, 4> points{};
};

}  // namespace hinge::molecular
