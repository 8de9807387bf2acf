// SPDX-License-Identifier: BSD-3-Clause
// BondJudge: decides by distance, valence and bond angles if two close atoms can be bonded.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Atoms are indices in Structure::atoms; coordinates are those of the first model. Keeps references to the structure.
class BondJudge {
 public:
  /// Knows the whole structure and its bonds.
  explicit BondJudge(const Structure& structure);
  /// Knows atoms [first, last) and no bond yet.
  BondJudge(const Structure& structure, std::uint32_t first, std::uint32_t last);

  /// Adds a bond. Bonds of metals count for coordination only.
  void join(std::uint32_t i, std::uint32_t j, BondOrder order = BondOrder::unknown);
  /// Removes a covalent bond.
  void part(std::uint32_t i, std::uint32_t j);

  /// Returns the reason why two close atoms of different residues are not bonded; empty if they can be. The bond i-j
  /// must not have been added. Conditions: the distance is that of a bond between the two elements; each atom has room
  /// for one more bond, with hydrogens that the file omits counted as bonds; the angles to existing bonds are bond
  /// angles. A metal bonds to N, O, S, Se, halogens, and the carbon of CO and CN.
  std::string refusal(std::uint32_t i, std::uint32_t j) const;

  /// Returns the number of bonds on the shortest path between i and j without the bond i-j (which was added); 0 if
  /// there is no such path, that is, the bond closes no ring.
  int bonds_around(std::uint32_t i, std::uint32_t j) const;
  /// True if the bond i-j can close a ring of `around` further bonds: its length is that of a bond, no atom has more
  /// bonds than its element allows, and the third bond of an aromatic carbon is planar. If around >= 4, the atoms would
  /// clash without the bond, so the angles must be bond angles too.
  bool may_close_ring(std::uint32_t i, std::uint32_t j, int around) const;

 private:
  struct Neighbour {
    std::uint32_t atom;
    BondOrder order;
  };
  const std::vector<Neighbour>& near(std::uint32_t i) const { return near_[i - first_]; }
  double distance(std::uint32_t i, std::uint32_t j) const;
  /// Angle k - i - j, degrees.
  double angle(std::uint32_t k, std::uint32_t i, std::uint32_t j) const;
  /// By the bond's order; by its length if the order is unknown.
  bool is_multiple(std::uint32_t i, const Neighbour& neighbour) const;
  int multiple_bonds(std::uint32_t i) const;
  bool has_terminal_oxygen(std::uint32_t i) const;
  /// Number of further bonds that the atom can have.
  int room(std::uint32_t i) const;
  int room_of_carbon(std::uint32_t i) const;
  int room_of_nitrogen(std::uint32_t i) const;
  int room_of_oxygen(std::uint32_t i) const;
  int room_of_sulphur(std::uint32_t i) const;
  /// True if the angles at i between its bonds and a bond to j are plausible.
  bool has_angles(std::uint32_t i, std::uint32_t j) const;
  bool has_ring_angles(std::uint32_t i, std::uint32_t j) const;
  std::string metal_refusal(std::uint32_t metal, std::uint32_t donor) const;

  const Structure& s_;
  const std::vector<Vec3>& x_;
  std::uint32_t first_;
  std::vector<std::vector<Neighbour>> near_;             // covalent bonds, by atom
  std::vector<std::vector<std::uint32_t>> coordinated_;  // bonds between metals and donors, by atom
};

}  // namespace hinge::molecular
