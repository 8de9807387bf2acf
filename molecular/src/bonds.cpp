// SPDX-License-Identifier: BSD-3-Clause
// Bond perception, one source after the other.
#include "hinge/molecular/bonds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>

#include "bond_list.hpp"
#include "cell_grid.hpp"
#include "hinge/molecular/residue_table.hpp"
#include "residue_bonds.hpp"

namespace hinge::molecular {

namespace {

/// An S-S bond is 2.05 A long; MD files record none, so SG pairs within about 10 % of it count.
constexpr double disulphide_min = 1.8, disulphide_max = 2.3;
/// A recorded disulphide or link longer than this is not there in these coordinates.
constexpr double recorded_disulphide_max = 2.5;
/// The same for bonds of metals: K-O, the longest of the common ones, is up to 3.2 A.
constexpr double recorded_coordination_max = 3.2;

class Perception {
 public:
  explicit Perception(Structure& structure) : s_(structure), x_(structure.models.front()), bonds_(structure) {}

  void run(ComponentLibrary& components) {
    ResidueBonds inside(s_, bonds_, components);
    for (std::uint32_t r = 0; r < s_.residues.size(); ++r) inside.add(r);
    for (const Chain& chain : s_.chains) bond_chain(chain);
    bond_recorded();
    bond_disulphides();
    bond_unknown();
    inside.say();
    finish();
  }

 private:
  bool in_polymer(std::uint32_t r) const {
    const Residue& residue = s_.residues[r];
    return residue.kind == ResidueKind::amino_acid || residue.kind == ResidueKind::nucleotide || is_cap(residue.name);
  }

  void bond_chain(const Chain& chain) {
    std::optional<std::uint32_t> first, last;
    for (std::uint32_t r = chain.first_residue; r < chain.last_residue; ++r) {
      if (!in_polymer(r)) continue;
      if (last && !bond_next(*last, r) && s_.residues[*last].kind == s_.residues[r].kind &&
          s_.residues[r].kind != ResidueKind::other)
        note_break(chain, *last, r);
      if (!first) first = r;
      last = r;
    }
    // A cyclic backbone: its ends meet. Two residues cannot close a ring of their own.
    if (first && last && *last > *first + 1) bond_next(*last, *first);
  }

  bool bond_next(std::uint32_t r, std::uint32_t t) {
    return bond(r, "C", t, "N", BondOrigin::peptide) || bond(r, "O3'", t, "P", BondOrigin::phosphodiester);
  }
  bool bond(std::uint32_t r, std::string_view a, std::uint32_t t, std::string_view b, BondOrigin origin) {
    const bool nucleotides = origin == BondOrigin::phosphodiester;
    if ((s_.residues[r].kind == ResidueKind::nucleotide) != nucleotides ||
        (s_.residues[t].kind == ResidueKind::nucleotide) != nucleotides)
      return false;
    const auto i = bonds_.find(r, a), j = bonds_.find(t, b);
    if (!i || !j || !bonds_.within_radii(*i, *j)) return false;
    bonds_.add(*i, *j, origin);
    return true;
  }

  void note_break(const Chain& chain, std::uint32_t r, std::uint32_t t) {
    const auto name = [&](std::uint32_t k) {
      const Residue& residue = s_.residues[k];
      return residue.name + std::to_string(residue.sequence_number) +
             (residue.insertion_code != '\0' ? std::string(1, residue.insertion_code) : "");
    };
    s_.notes.push_back("chain " + (chain.name.empty() ? "_" : chain.name) + ": break between " + name(r) + " and " +
                       name(t) + ", no bond across");
  }

  void bond_recorded() {
    std::size_t ignored = 0;
    std::string first_ignored;
    for (const Link& link : s_.links) {
      if (link.conect && s_.atoms[link.first].residue == s_.atoms[link.second].residue) continue;  // ResidueBonds'
      const double d = bonds_.distance(link.first, link.second);
      const bool metal = is_metal(s_.atoms[link.first].element) || is_metal(s_.atoms[link.second].element);
      const bool holds = link.disulphide ? d <= recorded_disulphide_max
                                         : bonds_.within_radii(link.first, link.second) ||
                                               (metal && !link.conect && d <= recorded_coordination_max);
      if (!holds) {
        if (++ignored == 1) {
          std::array<char, 32> length{};
          std::snprintf(length.data(), length.size(), "%.2f", d);
          first_ignored = label(s_, link.first) + " - " + label(s_, link.second) + " is " + length.data();
        }
        continue;
      }
      bonds_.add(link.first, link.second, link.disulphide ? BondOrigin::disulphide : BondOrigin::record, link.order);
    }
    if (ignored > 0)
      s_.notes.push_back("recorded bonds too long to hold, ignored: " + std::to_string(ignored) +
                         " (first: " + first_ignored + " angstrom)");
  }

  void bond_disulphides() {
    std::vector<std::uint32_t> sulphurs;
    for (std::uint32_t i = 0; i < s_.atoms.size(); ++i)
      if (s_.atoms[i].name == "SG" && s_.atoms[i].element == "S") sulphurs.push_back(i);
    CellGrid grid(x_, sulphurs, disulphide_max);
    for (const std::uint32_t i : sulphurs)
      grid.for_each_near(x_[i], [&](std::uint32_t j) {
        const double d = bonds_.distance(i, j);
        if (i < j && d >= disulphide_min && d <= disulphide_max) bonds_.add(i, j, BondOrigin::disulphide);
      });
  }

  /// Residues without a template may be bonded to anything: glycans, ligands, cofactors, metals.
  void bond_unknown() {
    std::vector<std::uint32_t> heavy;
    bool any = false;
    for (std::uint32_t i = 0; i < s_.atoms.size(); ++i) {
      if (!bonds_.hydrogen(i)) heavy.push_back(i);
      any = any || unknown(i);
    }
    if (any) {
      constexpr double longest = 2 * 2.4 + BondList::tolerance;  // two of the largest covalent radii
      CellGrid grid(x_, heavy, longest);
      for (const std::uint32_t i : heavy)
        if (unknown(i))
          grid.for_each_near(x_[i], [&](std::uint32_t j) {
            if (s_.atoms[i].residue != s_.atoms[j].residue && bonds_.within_radii(i, j))
              bonds_.add(i, j, BondOrigin::covalent_radii);
          });
    }
  }
  bool unknown(std::uint32_t i) const { return s_.residues[s_.atoms[i].residue].kind == ResidueKind::other; }

  void finish() {
    std::sort(s_.bonds.begin(), s_.bonds.end(),
              [](const Bond& a, const Bond& b) { return std::pair(a.first, a.second) < std::pair(b.first, b.second); });
  }

  Structure& s_;
  const std::vector<Vec3>& x_;
  BondList bonds_;
};

}  // namespace

void perceive_bonds(Structure& structure, ComponentLibrary components) {
  structure.bonds.clear();
  structure.bond_sources.clear();
  Perception(structure).run(components);
}

}  // namespace hinge::molecular
