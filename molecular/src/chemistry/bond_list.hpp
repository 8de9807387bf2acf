// SPDX-License-Identifier: BSD-3-Clause
// The bonds of a structure while they are found, and what every way to find them asks of atoms.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

class BondList {
 public:
  explicit BondList(Structure& structure) : s_(structure), x_(structure.models.front()) {}

  /// False when the bond is known already; its first origin and order count. Bonds of metals are coordination bonds.
  bool add(std::uint32_t i, std::uint32_t j, BondOrigin origin, BondOrder order = BondOrder::unknown);

  bool has(std::uint32_t i, std::uint32_t j) const;

  bool hydrogen(std::uint32_t i) const { return s_.atoms[i].element == "H"; }
  double distance(std::uint32_t i, std::uint32_t j) const { return std::sqrt(squared_norm(Vec3(x_[i] - x_[j]))); }
  /// Closer than covalent radii + tolerance, no two copies of one atom, no contact over a ligand's oxygen.
  bool within_radii(std::uint32_t i, std::uint32_t j) const;
  /// The atom of this name in a residue; of a nucleotide under its old name too.
  std::optional<std::uint32_t> find(std::uint32_t residue, std::string_view name) const;

  /// CSD rule: bonded when closer than the sum of covalent radii plus this (angstrom).
  static constexpr double tolerance = 0.4;

 private:
  Structure& s_;
  const std::vector<Vec3>& x_;
  std::unordered_set<std::uint64_t> seen_;
};

}  // namespace hinge::molecular
