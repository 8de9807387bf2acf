// SPDX-License-Identifier: BSD-3-Clause
// BondJudge: may two close atoms be bonded, as far as their distance, their valences and their bond angles tell?
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Atoms are positions in Structure::atoms, coordinates those of the first model.
class BondJudge {
 public:
  /// Of the whole structure, with the bonds it has.
  explicit BondJudge(const Structure& structure);
  /// Of atoms [first, last) alone; no bond is known yet.
  BondJudge(const Structure& structure, std::uint32_t first, std::uint32_t last);

  /// Makes a bond known. Bonds of metals count for their coordination alone.
  void join(std::uint32_t i, std::uint32_t j, BondOrder order = BondOrder::unknown);
  void part(std::uint32_t i, std::uint32_t j);

  /// Why two atoms of different residues that nothing but their distance joins are not bonded; empty where they may be.
  /// Bonds made known do not hold i and j together yet. They may be when all of this holds: the distance is that of a
  /// bond between their elements; each of them has room for one more bond, hydrogens that the file leaves out counted;
  /// the angles with the bonds they have are those of bonds. A metal is bonded to N, O, S, Se and halogens, and to the
  /// carbon of CO and CN.
  std::string refusal(std::uint32_t i, std::uint32_t j) const;

  /// Of the ring inside a residue that this bond (made known) closes: how many bonds join its atoms without it? 0:
  /// none, it closes no ring.
  int bonds_around(std::uint32_t i, std::uint32_t j) const;
  /// May it close a ring of so many further bonds? Its length is that of a bond, neither atom has more bonds than its
  /// element can, and where the two are four bonds apart without it, so that they would clash, the angles are those of
  /// bonds.
  bool may_close_ring(std::uint32_t i, std::uint32_t j, int around) const;

 private:
  struct Neighbour {
    std::uint32_t atom;
    BondOrder order;
  };
  const std::vector<Neighbour>& near(std::uint32_t i) const { return near_[i - first_]; }
  double distance(std::uint32_t i, std::uint32_t j) const;
  /// Of k - i - j, degrees.
  double angle(std::uint32_t k, std::uint32_t i, std::uint32_t j) const;
  /// By its order, else by its length.
  bool is_multiple(std::uint32_t i, const Neighbour& neighbour) const;
  int multiple_bonds(std::uint32_t i) const;
  bool has_terminal_oxygen(std::uint32_t i) const;
  /// For how many more bonds?
  int room(std::uint32_t i) const;
  int room_of_carbon(std::uint32_t i) const;
  int room_of_nitrogen(std::uint32_t i) const;
  int room_of_oxygen(std::uint32_t i) const;
  int room_of_sulphur(std::uint32_t i) const;
  /// Are the angles at i between its bonds and one to j plausible?
  bool has_angles(std::uint32_t i, std::uint32_t j) const;
  bool has_ring_angles(std::uint32_t i, std::uint32_t j) const;
  std::string metal_refusal(std::uint32_t metal, std::uint32_t donor) const;

  const Structure& s_;
  const std::vector<Vec3>& x_;
  std::uint32_t first_;
  std::vector<std::vector<Neighbour>> near_;             // covalent
  std::vector<std::vector<std::uint32_t>> coordinated_;  // metals to donors, and back
};

}  // namespace hinge::molecular
