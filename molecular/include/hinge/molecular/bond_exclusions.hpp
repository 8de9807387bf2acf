// SPDX-License-Identifier: BSD-3-Clause
// BondExclusions: the pair filter of molecules: TopDist(i, j) >= min_bonds (BioCD eq. (1)), except exempted pairs and
// pairs outside a scope.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/id.hpp"
#include "hinge/molecular/pair_scope.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/policy/pair_filter.hpp"

namespace hinge::molecular {

/// Number of bonds between two atoms from which the pair counts.
struct MinBonds {
  int heavy;     ///< for two heavy atoms
  int hydrogen;  ///< if one of them is a hydrogen

  /// The same number for all pairs.
  MinBonds(int bonds) : heavy(bonds), hydrogen(bonds) {}
  /// One number for pairs of heavy atoms, another for pairs with a hydrogen.
  MinBonds(int of_heavy, int with_hydrogen) : heavy(of_heavy), hydrogen(with_hydrogen) {}
  /// The number for atoms i and j of the structure.
  int of(const Structure& structure, std::uint32_t i, std::uint32_t j) const noexcept {
    return structure.atoms[i].element == "H" || structure.atoms[j].element == "H" ? hydrogen : heavy;
  }

  /// Returns true if both numbers are equal.
  friend bool operator==(const MinBonds&, const MinBonds&) = default;
};

/// Admits pairs of atoms whose shortest path has at least min_bonds bonds (the paper's "more than three bonds" is
/// min_bonds = 4), and atoms that no path of bonds connects. Primitive i is atom i. Copies share their data; const
/// members may be called by many threads at once.
class HINGE_API BondExclusions {
 public:
  /// min_bonds: both in 1 ... 16. exempt: further pairs that are not admitted. scope: made for this structure. Throws
  /// ModelError if a number is out of range, or an exempt pair is not two different atoms of the structure.
  BondExclusions(const Structure& structure, MinBonds min_bonds,
                 std::span<const std::pair<PrimitiveId, PrimitiveId>> exempt = {}, PairScope scope = {});

  /// True if the pair is in the scope and not listed by excluded().
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept { return in_scope(i, j) && !excludes(i, j); }
  /// True if the pair is in the scope, for any number of bonds.
  bool in_scope(PrimitiveId i, PrimitiveId j) const noexcept { return scope_.holds(i, j); }
  /// The atoms that are listed as excluded with i: too few bonds apart, or exempted. Sorted, without i. Valid for the
  /// lifetime of this object or of any copy.
  std::span<const PrimitiveId> excluded(PrimitiveId i) const noexcept {
    return std::span(data_->excluded)
        .subspan(data_->start[index(i)], data_->start[index(i) + 1] - data_->start[index(i)]);
  }
  /// Number of atoms.
  std::size_t size() const noexcept { return data_->start.size() - 1; }
  /// Number of unordered pairs that are listed as excluded.
  std::size_t excluded_pairs() const noexcept { return data_->excluded.size() / 2; }

 private:
  /// Bits of the atoms i - 64 ... i + 63 of an atom i. Nearly all excluded atoms are that close in the file. A look-up
  /// needs no branch on the distance of two atoms in the file, which is unpredictable.
  struct Window {
    static constexpr std::size_t size = 128;
    /// The place of atom j in the window of atom i; `size` or more if it is outside.
    static std::size_t place(PrimitiveId i, PrimitiveId j) noexcept { return index(j) - index(i) + size / 2; }
    std::array<std::uint64_t, size / 64> bits{};
    bool holds_all = true;  // no atom outside is excluded
  };

  bool excludes(PrimitiveId i, PrimitiveId j) const noexcept {
    const Window& window = data_->windows[index(i)];
    const std::size_t place = Window::place(i, j);
    if (window.holds_all || place < Window::size) [[likely]]
      return place < Window::size && (window.bits[place / 64] >> place % 64 & 1U) != 0;
    const auto list = excluded(i);
    return std::binary_search(list.begin(), list.end(), j);
  }

  struct Data {
    std::vector<std::size_t> start;
    std::vector<PrimitiveId> excluded;
    std::vector<Window> windows;
  };
  std::shared_ptr<const Data> data_;  // shared by the copies that engines and threads hold
  PairScope scope_;
};

static_assert(ListsExclusions<BondExclusions>);

/// Returns the neighbours of every atom in the bond graph, sorted.
HINGE_API std::vector<std::vector<std::uint32_t>> bonded_neighbours(const Structure& structure);

/// Returns the number of bonds on the shortest path between atoms i and j, or -1 if it is above `limit` or there is no
/// path. Linear in the number of bonds.
HINGE_API int bond_distance(const Structure& structure, std::uint32_t i, std::uint32_t j, int limit);

}  // namespace hinge::molecular
