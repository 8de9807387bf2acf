// SPDX-License-Identifier: BSD-3-Clause
// BondList: the bonds of a structure during perception, and the tests that all sources of bonds share.
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

/// Writes to Structure::bonds; keeps a reference to the structure. Distances are those of the first model, angstrom.
class BondList {
 public:
  explicit BondList(Structure& structure) : s_(structure), x_(structure.models.front()) {}

  /// Adds a bond; false if it is known already, with its first origin and order. Bonds of metals become coordination.
  bool add(std::uint32_t i, std::uint32_t j, BondOrigin origin, BondOrder order = BondOrder::unknown);

  /// True if the bond is known.
  bool has(std::uint32_t i, std::uint32_t j) const;

  bool hydrogen(std::uint32_t i) const { return s_.atoms[i].element == "H"; }
  double distance(std::uint32_t i, std::uint32_t j) const { return std::sqrt(squared_norm(Vec3(x_[i] - x_[j]))); }
  /// Sum of both covalent radii, angstrom.
  double radii(std::uint32_t i, std::uint32_t j) const;
  /// True if the distance is below the covalent radii + tolerance. False for two copies of one atom, and for contacts
  /// of a metal ion across a ligand's oxygen.
  bool within_radii(std::uint32_t i, std::uint32_t j) const;
  /// Returns the atom of this name in a residue; in a nucleotide also by its old name.
  std::optional<std::uint32_t> find(std::uint32_t residue, std::string_view name) const;

  /// CSD rule: atoms closer than the sum of covalent radii plus this are bonded (angstrom).
  static constexpr double tolerance = 0.4;

 private:
  Structure& s_;
  const std::vector<Vec3>& x_;
  std::unordered_set<std::uint64_t> seen_;
};

}  // namespace hinge::molecular
