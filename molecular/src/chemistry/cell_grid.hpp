// SPDX-License-Identifier: BSD-3-Clause
// CellGrid: finds neighbours within a fixed radius while bonds are perceived.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "hinge/core/vec3.hpp"

namespace hinge::molecular {

/// Cubic cells that list some atoms. Independent of its arguments after construction.
class CellGrid {
 public:
  /// atoms: indices in `positions`. cell: edge length of a cell, angstrom.
  CellGrid(std::span<const Vec3> positions, std::span<const std::uint32_t> atoms, double cell) : cell_(cell) {
    for (const std::uint32_t atom : atoms) cells_[key(positions[atom])].push_back(atom);
  }

  /// Calls visit(atom) for every atom in the cell of x and its 26 neighbours, which includes all atoms within one cell
  /// length.
  template <class Visit>
  void for_each_near(const Vec3& x, const Visit& visit) const {
    const Key centre = key(x);
    for (std::int64_t a = -1; a <= 1; ++a)
      for (std::int64_t b = -1; b <= 1; ++b)
        for (std::int64_t c = -1; c <= 1; ++c) {
          const auto found = cells_.find({centre[0] + a, centre[1] + b, centre[2] + c});
          if (found == cells_.end()) continue;
          for (const std::uint32_t atom : found->second) visit(atom);
        }
  }

 private:
  using Key = std::array<std::int64_t, 3>;
  Key key(const Vec3& x) const {
    // Coordinates far outside any molecule share border cells; the conversion does not overflow.
    const auto number = [&](double v) {
      return static_cast<std::int64_t>(std::floor(std::fmax(-1e15, std::fmin(1e15, v / cell_))));
    };
    return {number(x[0]), number(x[1]), number(x[2])};
  }
  double cell_;
  std::map<Key, std::vector<std::uint32_t>> cells_;
};

}  // namespace hinge::molecular
