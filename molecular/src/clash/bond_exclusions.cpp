// SPDX-License-Identifier: BSD-3-Clause
// Searches the bond graph breadth first from every atom, to the depth at which pairs start to count.
#include "hinge/molecular/bond_exclusions.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "hinge/core/error.hpp"

namespace hinge::molecular {

namespace {

/// Returns the atoms within `depth` bonds of `start`, level by level, `start` first; ends[k] is one past the last atom
/// of level k. seen: all zero, one per atom; zero again on return.
std::vector<std::uint32_t> around(const std::vector<std::vector<std::uint32_t>>& neighbours, std::uint32_t start,
                                  int depth, std::vector<std::uint8_t>& seen, std::vector<std::size_t>& ends) {
  std::vector<std::uint32_t> reached{start};
  seen[start] = 1;
  ends.assign(1, 1);
  std::size_t next = 0;
  for (int level = 0; level < depth; ++level) {
    const std::size_t end = reached.size();
    for (; next < end; ++next)
      for (const std::uint32_t atom : neighbours[reached[next]])
        if (seen[atom] == 0) {
          seen[atom] = 1;
          reached.push_back(atom);
        }
    ends.push_back(reached.size());
  }
  for (const std::uint32_t atom : reached) seen[atom] = 0;
  return reached;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> bonded_neighbours(const Structure& structure) {
  std::vector<std::vector<std::uint32_t>> neighbours(structure.atoms.size());
  for (const Bond& bond : structure.bonds) {
    neighbours[bond.first].push_back(bond.second);
    neighbours[bond.second].push_back(bond.first);
  }
  for (auto& list : neighbours) std::sort(list.begin(), list.end());
  return neighbours;
}

int bond_distance(const Structure& structure, std::uint32_t i, std::uint32_t j, int limit) {
  std::vector<std::uint8_t> seen(structure.atoms.size(), 0);
  std::vector<std::size_t> ends;
  const auto reached = around(bonded_neighbours(structure), i, limit, seen, ends);
  const auto found = std::find(reached.begin(), reached.end(), j);
  if (found == reached.end()) return -1;
  const auto position = static_cast<std::size_t>(found - reached.begin());
  return static_cast<int>(std::upper_bound(ends.begin(), ends.end(), position) - ends.begin());
}

BondExclusions::BondExclusions(const Structure& structure, MinBonds min_bonds,
                               std::span<const std::pair<PrimitiveId, PrimitiveId>> exempt, PairScope scope)
    : scope_(std::move(scope)) {
  // Beyond 16 bonds a list per atom would hold a large share of the molecule: use another data structure.
  for (const int bonds : {min_bonds.heavy, min_bonds.hydrogen})
    if (bonds < 1 || bonds > 16)
      throw ModelError("minimal bond distance " + std::to_string(bonds) + ": expected 1 to 16");
  const int deepest = std::max(min_bonds.heavy, min_bonds.hydrogen) - 1;
  const auto neighbours = bonded_neighbours(structure);
  std::vector<std::vector<PrimitiveId>> further(structure.atoms.size());
  for (const auto& [i, j] : exempt) {
    if (i == j || std::max(index(i), index(j)) >= further.size())
      throw ModelError("exempt pair " + std::to_string(index(i)) + ", " + std::to_string(index(j)) +
                       ": expected two different atoms below " + std::to_string(further.size()));
    further[index(i)].push_back(j);
    further[index(j)].push_back(i);
  }
  Data data;
  data.start.assign(1, 0);
  std::vector<std::uint8_t> seen(structure.atoms.size(), 0);
  std::vector<std::size_t> ends;
  for (std::uint32_t atom = 0; atom < structure.atoms.size(); ++atom) {
    std::vector<PrimitiveId> list = std::move(further[atom]);
    const auto reached = around(neighbours, atom, deepest, seen, ends);
    std::size_t next = 1;
    for (int bonds = 1; bonds <= deepest; ++bonds)
      for (; next < ends[static_cast<std::size_t>(bonds)]; ++next)
        if (bonds < min_bonds.of(structure, atom, reached[next])) list.push_back(id<PrimitiveId>(reached[next]));
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    data.excluded.insert(data.excluded.end(), list.begin(), list.end());
    Window window;
    for (const PrimitiveId j : list) {
      const std::size_t place = Window::place(id<PrimitiveId>(atom), j);
      if (place < Window::size)
        window.bits[place / 64] |= std::uint64_t{1} << place % 64;
      else
        window.holds_all = false;
    }
    data.windows.push_back(window);
    data.start.push_back(data.excluded.size());
  }
  data_ = std::make_shared<const Data>(std::move(data));
}

}  // namespace hinge::molecular
