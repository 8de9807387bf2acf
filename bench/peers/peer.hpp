// SPDX-License-Identifier: BSD-3-Clause
// Input and interface of every competitor of the engines. All of them decide in double, so their answers agree.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/detail/query/sort_hits.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge::bench {

/// Pairs i < j with their distances and thresholds, sorted by (i, j). All contestants sort in the same way.
using PairList = std::vector<Hit>;

/// Points, thresholds (angstrom) and admitted pairs. Prepared once per selection of DOF.
struct PeerInput {
  std::size_t n = 0;                                 // < 2^24
  std::vector<std::uint16_t> type;                   // per point, < type_count
  std::size_t type_count = 0;                        // <= 16
  std::vector<double> table;                         // type_count^2, row-major: M, symmetric
  std::vector<std::uint32_t> group;                  // rigid group of each point; group 0 never moves
  std::vector<std::vector<std::uint32_t>> excluded;  // per point, sorted; symmetric: bonded neighbours, constant pairs

  /// Whether the pair is tested.
  bool admits(std::uint32_t i, std::uint32_t j) const {
    return group[i] != group[j] && !std::binary_search(excluded[i].begin(), excluded[i].end(), j);
  }
  double threshold(std::uint32_t i, std::uint32_t j) const { return table[type[i] * type_count + type[j]]; }
};

// A peer P (no base class):
//   P(std::shared_ptr<const PeerInput>)
//   void update(std::span<const double> xyz)   3n world coordinates, x0 y0 z0 x1 ...; points of group 0 never change
//   bool any();
//   std::size_t count();                           number of pairs with d < M
//   void within(double margin, PairList& out);     d < M + margin; `out` is cleared first
//   double closest();                             smallest d - M; +inf when no pair is admitted
// Squared distances are dx * dx + dy * dy + dz * dz in double, compared as d2 < (M + margin) * (M + margin).

}  // namespace hinge::bench
