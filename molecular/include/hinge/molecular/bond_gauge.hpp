// SPDX-License-Identifier: BSD-3-Clause
// BondGauge: how far coordinates from elsewhere are from a molecule's bonds and from what closes its cycles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/molecular/molecule.hpp"

namespace hinge::molecular {

/// The bond whose length is farthest from the reference's; angstrom.
struct BondDeviation {
  std::uint32_t first = 0, second = 0;
  double length = 0.0, reference = 0.0;
  double residual = 0.0;  ///< |length - reference|
};

/// Lengths are compared with those in model 0. Positions: angstrom, one per atom.
class BondGauge {
 public:
  explicit BondGauge(const Molecule& molecule);

  /// Of each closure of the molecule's tree, angstrom: the largest change of the distance between the two atoms it
  /// joins and of those across its angles, from one to what is bonded to the other.
  std::vector<double> closure_residuals(std::span<const Vec3> positions) const;
  /// The first of those farthest off; all 0 for a molecule without bonds.
  BondDeviation worst_bond(std::span<const Vec3> positions) const;

 private:
  struct Kept {
    std::uint32_t first, second;
    double length;
  };
  std::vector<Kept> bonds_;
  std::vector<std::vector<Kept>> closures_;
};

}  // namespace hinge::molecular
