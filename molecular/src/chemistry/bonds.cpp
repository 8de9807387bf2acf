// SPDX-License-Identifier: BSD-3-Clause
// perceive_bonds: applies the sources of bonds in order.
#include "hinge/molecular/bonds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "chemistry/bond_judge.hpp"
#include "chemistry/bond_list.hpp"
#include "chemistry/cell_grid.hpp"
#include "chemistry/counted.hpp"
#include "chemistry/residue_bonds.hpp"
#include "chemistry/residue_table.hpp"
#include "hinge/core/number_text.hpp"

namespace hinge::molecular {

namespace {

/// An S-S bond is 2.05 A long. MD files do not record it, so SG pairs within about 10 % of that length count.
constexpr double disulphide_min = 1.8, disulphide_max = 2.3;
/// A longer recorded disulphide is ignored: it does not exist in these coordinates (angstrom).
constexpr double recorded_disulphide_max = 2.5;
/// The bound for recorded bonds of metals: K-O, the longest common one, is up to 3.2 A.
constexpr double recorded_coordination_max = 3.2;

class Perception {
 public:
  Perception(Structure& structure, BondSearch between)
      : s_(structure), x_(structure.models.front()), between_(between), bonds_(structure) {}

  void run(ComponentLibrary& components) {
    ResidueBonds inside(s_, bonds_, components);
    for (std::uint32_t r = 0; r < s_.residues.size(); ++r) inside.add(r);
    for (const Chain& chain : s_.chains) bond_chain(chain);
    find_out_of_order();
    closing_ = closing_bonds();
    bond_recorded();
    if (between_ == BondSearch::geometry) bond_by_distance();
    inside.say();
    std::sort(s_.bonds.begin(), s_.bonds.end(), before);
  }

 private:
  struct Candidate {
    std::uint32_t first, second;
    BondOrigin origin;
    double misfit;  ///< |length - sum of covalent radii|, angstrom
  };

  bool in_polymer(std::uint32_t r) const {
    const Residue& residue = s_.residues[r];
    return residue.kind == ResidueKind::amino_acid || residue.kind == ResidueKind::nucleotide || is_cap(residue.name);
  }

  void bond_chain(const Chain& chain) {
    std::optional<std::uint32_t> first, last;
    std::vector<std::string> breaks;
    for (std::uint32_t r = chain.first_residue; r < chain.last_residue; ++r) {
      if (!in_polymer(r)) continue;
      if (!last || !bond_next(*last, r)) {
        if (last && s_.residues[*last].kind == s_.residues[r].kind && s_.residues[r].kind != ResidueKind::other)
          breaks.push_back(name_of(*last) + " and " + name_of(r));
        pieces_.emplace_back(r, r);
      }
      pieces_.back().second = r;
      if (!first) first = r;
      last = r;
    }
    if (!breaks.empty()) note_breaks(chain, breaks);
    // The ends of a cyclic backbone are bonded. A chain of two residues cannot form a ring.
    if (first && last && *last > *first + 1) ends_.emplace_back(*last, *first);
  }

  /// Finds pieces of a chain that follow each other by number, but not in the file. The bond between them is tested
  /// like the bond that closes a backbone.
  void find_out_of_order() {
    const auto key = [&](std::uint32_t r, int before) {
      const Residue& residue = s_.residues[r];
      return std::pair(s_.chains[residue.chain].name, residue.sequence_number - before);
    };
    std::map<std::pair<std::string, int>, std::uint32_t> lasts;
    for (const auto& [first, last] : pieces_) lasts.emplace(key(last, 0), last);
    for (const auto& [first, last] : pieces_)
      if (const auto before = lasts.find(key(first, 1)); before != lasts.end())
        ends_.emplace_back(before->second, first);
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

  std::string name_of(std::uint32_t r) const {
    const Residue& residue = s_.residues[r];
    return residue.name + std::to_string(residue.sequence_number) +
           (residue.insertion_code != '\0' ? std::string(1, residue.insertion_code) : "");
  }

  /// Adds one note for all breaks of a chain. A nucleic acid without phosphates has a break at each residue.
  void note_breaks(const Chain& chain, const std::vector<std::string>& breaks) {
    constexpr std::size_t named = 10;
    std::string text = "chain " + (chain.name.empty() ? "_" : chain.name) +
                       (breaks.size() == 1 ? ": break between " : ": breaks between ") + breaks.front();
    for (std::size_t k = 1; k < std::min(breaks.size(), named); ++k) text += ", " + breaks[k];
    if (breaks.size() > named) text += ", and " + std::to_string(breaks.size() - named) + " more";
    s_.notes.push_back(text + "; no bond across");
  }

  void bond_recorded() {
    Counted ignored;
    for (const BondRecord& bond : s_.bond_records) {
      if (bond.conect && s_.atoms[bond.first].residue == s_.atoms[bond.second].residue) continue;  // in ResidueBonds
      const double d = bonds_.distance(bond.first, bond.second);
      const bool metal = is_metal(s_.atoms[bond.first].element) || is_metal(s_.atoms[bond.second].element);
      const bool holds = bond.disulphide ? d <= recorded_disulphide_max
                                         : bonds_.within_radii(bond.first, bond.second) ||
                                               (metal && !bond.conect && d <= recorded_coordination_max);
      if (!holds) {
        ignored.add([&] { return label(s_, bond.first) + " - " + label(s_, bond.second) + " is " + fixed_text(d, 2); });
        continue;
      }
      bonds_.add(bond.first, bond.second, origin_of(bond), bond.order);
    }
    if (ignored.number > 0)
      s_.notes.push_back("recorded bonds ignored because they are too long: " + std::to_string(ignored.number) +
                         " (first: " + ignored.first + " angstrom)");
  }

  /// Adds bonds between residues that are known from their distance alone: disulphides, bonds that close a backbone,
  /// and bonds of residues without a template (glycans, ligands, cofactors, metals).
  void bond_by_distance() {
    const std::size_t told = s_.bonds.size();
    BondJudge judge(s_);
    std::vector<Candidate> found = disulphides();
    found.insert(found.end(), closing_.begin(), closing_.end());
    const std::vector<Candidate> others = of_unknown_residues();
    found.insert(found.end(), others.begin(), others.end());
    // Lengths closest to a typical bond's come first: each accepted bond uses up valences.
    std::stable_sort(found.begin(), found.end(),
                     [](const Candidate& a, const Candidate& b) { return a.misfit < b.misfit; });
    Counted refused;
    for (const Candidate& bond : found) {
      if (bonds_.has(bond.first, bond.second)) continue;
      const std::string reason = judge.refusal(bond.first, bond.second);
      if (!reason.empty()) {
        refused.add([&] { return named(bond) + ": " + reason; });
        continue;
      }
      bonds_.add(bond.first, bond.second, bond.origin);
      judge.join(bond.first, bond.second);
    }
    std::vector<Bond> added(s_.bonds.begin() + static_cast<std::ptrdiff_t>(told), s_.bonds.end());
    std::sort(added.begin(), added.end(), before);
    for (const Bond& bond : added)
      s_.notes.push_back("bond found by distance, not recorded in the file: " +
                         named({bond.first, bond.second, bond.origin, 0.0}));
    if (refused.number > 0)
      s_.notes.push_back("close enough for a bond, but not bonded: " + std::to_string(refused.number) +
                         " pairs (first: " + refused.first + ")");
  }

  /// Returns backbone bonds between `ends_`, if they are short enough.
  std::vector<Candidate> closing_bonds() const {
    std::vector<Candidate> found;
    for (const auto& [last, first] : ends_)
      for (const auto& [a, b, origin] :
           {std::tuple("C", "N", BondOrigin::peptide), std::tuple("O3'", "P", BondOrigin::phosphodiester)}) {
        const auto i = bonds_.find(last, a), j = bonds_.find(first, b);
        if (i && j && bonds_.within_radii(*i, *j)) found.push_back(candidate(*i, *j, origin));
      }
    return found;
  }
  /// The origin of a recorded bond: a bond that closes a backbone is one of the polymer's.
  BondOrigin origin_of(const BondRecord& bond) const {
    if (bond.disulphide) return BondOrigin::disulphide;
    for (const Candidate& closing : closing_)
      if (std::minmax(bond.first, bond.second) == std::minmax(closing.first, closing.second)) return closing.origin;
    return BondOrigin::record;
  }

  Candidate candidate(std::uint32_t i, std::uint32_t j, BondOrigin origin) const {
    return {std::min(i, j), std::max(i, j), origin, std::abs(bonds_.distance(i, j) - bonds_.radii(i, j))};
  }
  std::string named(const Candidate& bond) const {
    return label(s_, bond.first) + " - " + label(s_, bond.second) + ", " +
           fixed_text(bonds_.distance(bond.first, bond.second), 3) + " angstrom";
  }

  std::vector<Candidate> disulphides() const {
    std::vector<std::uint32_t> sulphurs;
    for (std::uint32_t i = 0; i < s_.atoms.size(); ++i)
      if (s_.atoms[i].name == "SG" && s_.atoms[i].element == "S") sulphurs.push_back(i);
    CellGrid grid(x_, sulphurs, disulphide_max);
    std::vector<Candidate> found;
    for (const std::uint32_t i : sulphurs)
      grid.for_each_near(x_[i], [&](std::uint32_t j) {
        const double d = bonds_.distance(i, j);
        if (i < j && d >= disulphide_min && d <= disulphide_max)
          found.push_back(candidate(i, j, BondOrigin::disulphide));
      });
    return found;
  }

  /// Residues without a template may be bonded to any atom.
  std::vector<Candidate> of_unknown_residues() const {
    std::vector<std::uint32_t> heavy;
    bool any = false;
    for (std::uint32_t i = 0; i < s_.atoms.size(); ++i) {
      if (!bonds_.hydrogen(i)) heavy.push_back(i);
      any = any || unknown(i);
    }
    std::vector<Candidate> found;
    if (!any) return found;
    constexpr double longest = 2 * 2.4 + BondList::tolerance;  // above twice the largest covalent radius
    CellGrid grid(x_, heavy, longest);
    for (const std::uint32_t i : heavy)
      if (unknown(i))
        grid.for_each_near(x_[i], [&](std::uint32_t j) {
          if (s_.atoms[i].residue != s_.atoms[j].residue && (i < j || !unknown(j)) && bonds_.within_radii(i, j))
            found.push_back(candidate(i, j, BondOrigin::covalent_radii));
        });
    return found;
  }
  bool unknown(std::uint32_t i) const { return s_.residues[s_.atoms[i].residue].kind == ResidueKind::other; }

  static bool before(const Bond& a, const Bond& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  }

  Structure& s_;
  const std::vector<Vec3>& x_;
  BondSearch between_;
  BondList bonds_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pieces_;  // first and last residue of each bonded run of a chain
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ends_;    // last and first residues that a bond may join
  std::vector<Candidate> closing_;
};

}  // namespace

void perceive_bonds(Structure& structure, ComponentLibrary components, BondSearch between) {
  structure.bonds.clear();
  structure.bond_sources.clear();
  Perception(structure, between).run(components);
}

}  // namespace hinge::molecular
