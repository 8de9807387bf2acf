// SPDX-License-Identifier: BSD-3-Clause
// BondExclusions: the pair filter of molecules, TopDist(i, j) >= min_bonds (BioCD eq. (1)), less pairs exempted by hand
// and those nobody asks about.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/molecular/pair_scope.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/policy/pair_filter.hpp"

namespace hinge::molecular {

/// From how many bonds apart on a pair counts: of heavy atoms, and one with a hydrogen.
struct MinBonds {
  int heavy;
  int hydrogen;

  /// The same for all pairs.
  MinBonds(int bonds) : heavy(bonds), hydrogen(bonds) {}
  MinBonds(int of_heavy, int with_hydrogen) : heavy(of_heavy), hydrogen(with_hydrogen) {}
  int of(const Structure& structure, std::uint32_t i, std::uint32_t j) const noexcept {
    return structure.atoms[i].element == "H" || structure.atoms[j].element == "H" ? hydrogen : heavy;
  }

  friend bool operator==(const MinBonds&, const MinBonds&) = default;
};

/// Primitive i is atom i. A pair is admitted when at least min_bonds bonds lie on the shortest way between the two
/// atoms (the paper's "more than three bonds" is min_bonds = 4); atoms that no chain of bonds joins are always
/// admitted.
class BondExclusions {
 public:
  /// min_bonds: 1 ... 16, else ModelError. exempt: further pairs that never count. scope: made for the structure.
  BondExclusions(const Structure& structure, MinBonds min_bonds,
                 std::span<const std::pair<PrimitiveId, PrimitiveId>> exempt = {}, PairScope scope = {});

  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    const auto list = excluded(i);
    return in_scope(i, j) && !std::binary_search(list.begin(), list.end(), j);
  }
  /// Is the pair asked about, however many bonds lie between the two?
  bool in_scope(PrimitiveId i, PrimitiveId j) const noexcept { return scope_.holds(i, j); }
  /// Atoms too few bonds away from i, and those exempted with it: sorted, without i.
  std::span<const PrimitiveId> excluded(PrimitiveId i) const noexcept {
    return std::span(data_->excluded)
        .subspan(data_->start[index(i)], data_->start[index(i) + 1] - data_->start[index(i)]);
  }
  std::size_t size() const noexcept { return data_->start.size() - 1; }
  /// Number of unordered pairs that are listed: too few bonds apart, or exempted.
  std::size_t excluded_pairs() const noexcept { return data_->excluded.size() / 2; }

 private:
  struct Data {
    std::vector<std::size_t> start;
    std::vector<PrimitiveId> excluded;
  };
  std::shared_ptr<const Data> data_;  // shared by the copies that engines and threads hold
  PairScope scope_;
};

static_assert(ListsExclusions<BondExclusions>);

/// Neighbours of every atom in the bond graph, sorted.
std::vector<std::vector<std::uint32_t>> bonded_neighbours(const Structure& structure);

/// Number of bonds on the shortest way between two atoms, or -1 when it is longer than `limit` or there is none.
int bond_distance(const Structure& structure, std::uint32_t i, std::uint32_t j, int limit);

}  // namespace hinge::molecular
