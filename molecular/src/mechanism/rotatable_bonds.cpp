// SPDX-License-Identifier: BSD-3-Clause
// Applies the rule for rotatable bonds: finds rings, bond orders and the residues to which the rule applies.
#include "mechanism/rotatable_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace hinge::molecular {

namespace {

bool is_polymer_bond(const Bond& bond) {
  return bond.origin == BondOrigin::peptide || bond.origin == BondOrigin::phosphodiester ||
         bond.origin == BondOrigin::disulphide;
}

class BondRule {
 public:
  explicit BondRule(const Structure& s) : s_(s), bonds_of_(s.atoms.size()), in_ring_(s.bonds.size(), false) {
    find_open();
    for (std::uint32_t k = 0; k < s_.bonds.size(); ++k) {
      const Bond& bond = s_.bonds[k];
      if (!heavy(bond.first) || !heavy(bond.second)) continue;
      if (!open_[residue(bond.first)] && !open_[residue(bond.second)]) continue;
      bonds_of_[bond.first].push_back(k);
      bonds_of_[bond.second].push_back(k);
    }
    find_rings();
  }

  std::vector<Bond> run(const AtomPairs& named) const {
    std::vector<Bond> found;
    for (std::uint32_t k = 0; k < s_.bonds.size(); ++k) {
      const Bond& bond = s_.bonds[k];
      const bool looked_at = open_[residue(bond.first)] || open_[residue(bond.second)];
      if (looked_at && heavy(bond.first) && heavy(bond.second) && !is_polymer_bond(bond) && !in_ring_[k] &&
          !named.contains({bond.first, bond.second}) && is_single(bond) && continues(bond.first, k) &&
          continues(bond.second, k) && !is_amide(bond.first, bond.second) && !is_amide(bond.second, bond.first))
        found.push_back(bond);
    }
    return found;
  }

 private:
  bool heavy(std::uint32_t i) const { return s_.atoms[i].element != "H"; }
  std::uint32_t residue(std::uint32_t i) const { return s_.atoms[i].residue; }
  std::string_view element(std::uint32_t i) const { return s_.atoms[i].element; }
  std::uint32_t other(std::uint32_t k, std::uint32_t i) const {
    return s_.bonds[k].first == i ? s_.bonds[k].second : s_.bonds[k].first;
  }

  /// Marks the residues to which the rule applies: residues of kind `other`, and residues with a bond that comes
  /// neither from our tables nor from a polymer or coordination bond. All other residues get their torsions from the
  /// tables.
  void find_open() {
    open_.resize(s_.residues.size());
    for (std::uint32_t r = 0; r < s_.residues.size(); ++r) open_[r] = s_.residues[r].kind == ResidueKind::other;
    for (const Bond& bond : s_.bonds) {
      const bool known = is_polymer_bond(bond) || bond.origin == BondOrigin::residue_template;
      if (!known && bond.order != BondOrder::coordination)
        open_[residue(bond.first)] = open_[residue(bond.second)] = true;
    }
  }

  /// Marks the ring bonds: a bond is in a ring unless removing it disconnects the bonds of its residue (Tarjan's bridge
  /// search, depth first).
  void find_rings() {
    constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> order(s_.atoms.size(), unseen), low(s_.atoms.size(), unseen);
    struct Visit {
      std::uint32_t atom, by;  // bond through which the search reached the atom
      std::size_t next = 0;
    };
    std::uint32_t count = 0;
    for (std::uint32_t root = 0; root < s_.atoms.size(); ++root) {
      if (order[root] != unseen || bonds_of_[root].empty()) continue;
      std::vector<Visit> stack{{root, unseen}};
      order[root] = low[root] = count++;
      while (!stack.empty()) {
        Visit& top = stack.back();
        const std::uint32_t atom = top.atom;
        if (top.next < bonds_of_[atom].size()) {
          const std::uint32_t k = bonds_of_[atom][top.next++], to = other(k, atom);
          if (k == top.by || residue(to) != residue(atom)) continue;
          if (order[to] == unseen) {
            order[to] = low[to] = count++;
            stack.push_back({to, k});
          } else {
            in_ring_[k] = true;
            low[atom] = std::min(low[atom], order[to]);
          }
          continue;
        }
        const std::uint32_t by = top.by;
        stack.pop_back();
        if (stack.empty()) break;
        const std::uint32_t parent = stack.back().atom;
        low[parent] = std::min(low[parent], low[atom]);
        in_ring_[by] = low[atom] <= order[parent];
      }
    }
  }

  /// Returns true if the atom has a heavy neighbour across a bond other than k. Coordination bonds do not count.
  bool continues(std::uint32_t atom, std::uint32_t k) const {
    return std::any_of(bonds_of_[atom].begin(), bonds_of_[atom].end(), [&](std::uint32_t other_bond) {
      return other_bond != k && s_.bonds[other_bond].order != BondOrder::coordination;
    });
  }

  bool is_single(const Bond& bond) const {
    if (bond.order != BondOrder::unknown) return bond.order == BondOrder::single;
    const double d = norm(Vec3(s_.models.front()[bond.first] - s_.models.front()[bond.second]));
    return d >= single_bond_from(element(bond.first), element(bond.second));
  }

  /// Returns true if `nitrogen` is N, `carbon` is C, and the carbon has a double bond outside rings to O, S or another
  /// N.
  bool is_amide(std::uint32_t nitrogen, std::uint32_t carbon) const {
    if (element(nitrogen) != "N" || element(carbon) != "C") return false;
    return std::any_of(bonds_of_[carbon].begin(), bonds_of_[carbon].end(), [&](std::uint32_t k) {
      const std::string_view partner = element(other(k, carbon));
      return !in_ring_[k] && other(k, carbon) != nitrogen && (partner == "O" || partner == "S" || partner == "N") &&
             !is_single(s_.bonds[k]);
    });
  }

  const Structure& s_;
  std::vector<bool> open_;                            // per residue: does the rule apply?
  std::vector<std::vector<std::uint32_t>> bonds_of_;  // per atom: its bonds to heavy atoms under the rule
  std::vector<bool> in_ring_;                         // per bond
};

}  // namespace

double single_bond_from(std::string_view a, std::string_view b) noexcept {
  if (b < a) std::swap(a, b);
  if (a == "C" && b == "C") return 1.43;
  if (a == "C" && b == "N") return 1.41;
  if (a == "N" && b == "N") return 1.32;
  return a == "C" && b == "O" ? single_carbon_oxygen : 0.0;
}

std::vector<Bond> rotatable_bonds(const Structure& structure, const AtomPairs& named) {
  return BondRule(structure).run(named);
}

}  // namespace hinge::molecular
