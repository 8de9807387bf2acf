// SPDX-License-Identifier: BSD-3-Clause
// HeldPlacement: two rigid fragments of a molecule with torsions between them that keep their relative pose.
#pragma once

#include <array>
#include <cstdint>

namespace hinge::molecular {

/// The rigid fragments of two atoms keep their relative pose in model 0, by closures. points: four atoms, not all in
/// one plane; the residual of the closures is measured at their positions.
struct HeldPlacement {
  /// One atom of each fragment, off torsion axes: an axis atom belongs to two fragments.
  std::array<std::uint32_t, 2> atoms{};
  std::array<std::uint32_t, 4> points{};  ///< anywhere in the structure; far apart is best
};

}  // namespace hinge::molecular
