// SPDX-License-Identifier: BSD-3-Clause
// ExtremesPeer: another library whose decisions dial --extremes shows. The product has none; bench/peers/biocd_fcl.cpp
// has FCL.
#pragma once

#include "hinge/core/vec3.hpp"

namespace biocd {

struct ExtremesPeer {
  const char* name;
  /// Decides whether two atoms are closer than the threshold (angstrom).
  bool (*collide)(const hinge::Vec3& a, const hinge::Vec3& b, double threshold);
};

/// Returns null if this program has none.
const ExtremesPeer* extremes_peer();

}  // namespace biocd
