// SPDX-License-Identifier: BSD-3-Clause
// BondGauge: how far given coordinates deviate from a molecule's bonds and closures.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/molecule.hpp"

namespace hinge::molecular {

/// The bond whose length deviates most from the reference; atom indices, lengths in angstrom.
struct BondDeviation {
  std::uint32_t first = 0;   ///< atom
  std::uint32_t second = 0;  ///< atom
  double length = 0.0;       ///< for the given positions
  double reference = 0.0;    ///< in model 0
  double residual = 0.0;     ///< |length - reference|
};

/// Compares distances with those in model 0. Independent of the molecule after construction. Const members may be
/// called by many threads at once.
class HINGE_API BondGauge {
 public:
  /// Measures the bonds and closures of the molecule in model 0.
  explicit BondGauge(const Molecule& molecule);

  /// Returns one residual per closure of the molecule's tree, angstrom: the largest change of the distance between the
  /// closure's two atoms, or between one of them and a bond neighbour of the other (these fix the angles). positions:
  /// angstrom, one per atom.
  std::vector<double> closure_residuals(std::span<const Vec3> positions) const;
  /// Returns the first bond with the largest deviation; all 0 if the molecule has no bonds. positions: angstrom, one
  /// per atom.
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
