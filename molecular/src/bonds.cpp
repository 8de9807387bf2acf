// SPDX-License-Identifier: BSD-3-Clause
// Bond perception, one source after the other.
#include "hinge/molecular/bonds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "cell_grid.hpp"
#include "hinge/molecular/residue_table.hpp"

namespace hinge::molecular {

namespace {

/// CSD rule: bonded when closer than the sum of covalent radii plus this (angstrom).
constexpr double bond_tolerance = 0.4;
/// An S-S bond is 2.05 A long; MD files record none, so SG pairs within about 10 % of it count.
constexpr double disulphide_min = 1.8, disulphide_max = 2.3;
/// A recorded disulphide or link longer than this is not there in these coordinates.
constexpr double recorded_disulphide_max = 2.5;
/// Atoms closer than this are two copies of one, as in doubled files (the bound of Open Babel, angstrom).
constexpr double coincident_max = 0.4;
/// X-H is at most 1.35 A (S-H); a hydrogen farther than this from every heavy atom of its residue is left unbonded.
constexpr double hydrogen_bond_max = 1.6;

/// Pairs that the radii call bonded but are contacts over a ligand's oxygen: a metal ion and phosphorus, an alkali or
/// alkaline earth ion and the carbon of a carboxylate.
bool is_contact(std::string_view ion, std::string_view other) {
  static constexpr std::array<std::string_view, 16> ions{"Li", "Na", "K",  "Rb", "Cs", "Mg", "Ca", "Sr",
                                                         "Ba", "Mn", "Fe", "Co", "Ni", "Cu", "Zn", "Cd"};
  constexpr std::ptrdiff_t alkaline = 9;  // the first of them
  const auto last = other == "C" ? ions.begin() + alkaline : ions.end();
  return (other == "C" || other == "P") && std::find(ions.begin(), last, ion) != last;
}

class Perception {
 public:
  explicit Perception(Structure& structure) : s_(structure), x_(structure.models.front()) {}

  void run() {
    for (std::uint32_t r = 0; r < s_.residues.size(); ++r) bond_residue(r);
    for (const Chain& chain : s_.chains) bond_chain(chain);
    bond_recorded();
    bond_disulphides();
    bond_unknown();
    finish();
  }

 private:
  static std::string& append(std::string& list, const std::string& word) {
    if (!list.empty()) list += ", ";
    return list += word;
  }
  bool hydrogen(std::uint32_t i) const { return s_.atoms[i].element == "H"; }
  const Residue& residue_of(std::uint32_t i) const { return s_.residues[s_.atoms[i].residue]; }
  double distance(std::uint32_t i, std::uint32_t j) const { return std::sqrt(squared_norm(Vec3(x_[i] - x_[j]))); }
  bool within_radii(std::uint32_t i, std::uint32_t j) const {
    const std::string &a = s_.atoms[i].element, &b = s_.atoms[j].element;
    if (is_contact(a, b) || is_contact(b, a)) return false;
    const double d = distance(i, j);
    return d > coincident_max && d < covalent_radius(a) + covalent_radius(b) + bond_tolerance;
  }
  std::optional<std::uint32_t> find(std::uint32_t r, std::string_view name) const {
    for (std::uint32_t i = s_.residues[r].first_atom; i < s_.residues[r].last_atom; ++i)
      if (s_.atoms[i].name == name) return i;
    return std::nullopt;
  }

  void add(std::uint32_t i, std::uint32_t j, BondOrigin origin) {
    const auto [a, b] = std::minmax(i, j);
    if (seen_.insert((std::uint64_t{a} << 32) | b).second) s_.bonds.push_back({a, b, origin});
  }

  /// Bonds inside one residue: by template where there is one, by covalent radii for atoms it does not know.
  void bond_residue(std::uint32_t r) {
    const Residue& residue = s_.residues[r];
    const ResidueTemplate* known =
        residue.kind == ResidueKind::amino_acid ? find_residue_template(residue.name) : nullptr;
    std::set<std::uint32_t> in_template;
    if (known != nullptr) {
      const auto bond = [&](std::string_view a, std::string_view b) {
        const auto i = find(r, a), j = find(r, b);
        if (i) in_template.insert(*i);
        if (j) in_template.insert(*j);
        if (i && j) add(*i, *j, BondOrigin::residue_template);
      };
      for_each_bond(backbone_bonds, bond);
      for_each_bond(known->side_chain, bond);
    } else {
      ++untabled_[residue.name];
    }
    for (std::uint32_t i = residue.first_atom; i < residue.last_atom; ++i) {
      if (hydrogen(i)) {
        bond_hydrogen(i, residue);
        continue;
      }
      for (std::uint32_t j = residue.first_atom; j < i; ++j)
        if (!hydrogen(j) && !(in_template.contains(i) && in_template.contains(j)) && within_radii(i, j))
          add_by_radii(j, i, known != nullptr);
    }
  }
  void add_by_radii(std::uint32_t i, std::uint32_t j, bool beyond_template) {
    const std::size_t before = s_.bonds.size();
    add(i, j, BondOrigin::covalent_radii);
    if (beyond_template && s_.bonds.size() > before) extended_.insert(residue_of(j).name);
  }

  /// A hydrogen has exactly one bond, to the nearest heavy atom of its residue.
  void bond_hydrogen(std::uint32_t h, const Residue& residue) {
    std::optional<std::uint32_t> bearer;
    double nearest = hydrogen_bond_max;
    for (std::uint32_t i = residue.first_atom; i < residue.last_atom; ++i)
      if (!hydrogen(i) && distance(i, h) < nearest) {
        nearest = distance(i, h);
        bearer = i;
      }
    if (bearer)
      add(*bearer, h, BondOrigin::residue_template);
    else
      s_.notes.push_back(label(s_, h) + ": no heavy atom of its residue within 1.6 angstrom, left unbonded");
  }

  bool in_polymer(std::uint32_t r) const {
    const Residue& residue = s_.residues[r];
    return residue.kind == ResidueKind::amino_acid || is_cap(residue.name);
  }

  void bond_chain(const Chain& chain) {
    std::optional<std::uint32_t> first, last;
    for (std::uint32_t r = chain.first_residue; r < chain.last_residue; ++r) {
      if (s_.residues[r].kind == ResidueKind::nucleotide && r > chain.first_residue) {
        const auto o = find(r - 1, "O3'"), p = find(r, "P");
        if (o && p && within_radii(*o, *p)) add(*o, *p, BondOrigin::covalent_radii);
      }
      if (!in_polymer(r)) continue;
      if (last && !bond_peptide(*last, r) && s_.residues[*last].kind == ResidueKind::amino_acid &&
          s_.residues[r].kind == ResidueKind::amino_acid)
        note_break(chain, *last, r);
      if (!first) first = r;
      last = r;
    }
    // A cyclic backbone: its ends meet. Two residues cannot close a ring of their own.
    if (first && last && *last > *first + 1) bond_peptide(*last, *first);
  }

  bool bond_peptide(std::uint32_t r, std::uint32_t t) {
    const auto c = find(r, "C"), n = find(t, "N");
    if (!c || !n || !within_radii(*c, *n)) return false;
    add(*c, *n, BondOrigin::peptide);
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
      const double d = distance(link.first, link.second);
      const bool holds = link.disulphide ? d <= recorded_disulphide_max : within_radii(link.first, link.second);
      if (!holds) {
        if (++ignored == 1) {
          std::array<char, 32> length{};
          std::snprintf(length.data(), length.size(), "%.2f", d);
          first_ignored = label(s_, link.first) + " - " + label(s_, link.second) + " is " + length.data();
        }
        continue;
      }
      add(link.first, link.second, link.disulphide ? BondOrigin::disulphide : BondOrigin::record);
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
        const double d = distance(i, j);
        if (i < j && d >= disulphide_min && d <= disulphide_max) add(i, j, BondOrigin::disulphide);
      });
  }

  /// Residues without a template may be bonded to anything: glycans, ligands, cofactors, metals.
  void bond_unknown() {
    std::vector<std::uint32_t> heavy;
    bool any = false;
    for (std::uint32_t i = 0; i < s_.atoms.size(); ++i) {
      if (!hydrogen(i)) heavy.push_back(i);
      any = any || unknown(i);
    }
    if (any) {
      constexpr double longest = 2 * 2.4 + bond_tolerance;  // two of the largest covalent radii
      CellGrid grid(x_, heavy, longest);
      for (const std::uint32_t i : heavy)
        if (unknown(i))
          grid.for_each_near(x_[i], [&](std::uint32_t j) {
            if (s_.atoms[i].residue != s_.atoms[j].residue && within_radii(i, j)) add(i, j, BondOrigin::covalent_radii);
          });
    }
    std::string names;
    for (const std::string& name : extended_) append(names, name);
    if (!names.empty()) s_.notes.push_back("bonds by covalent radii for atoms beyond the template of: " + names);
    if (untabled_.empty()) return;
    names.clear();
    for (const auto& [name, count] : untabled_) append(names, name).append(" x").append(std::to_string(count));
    s_.notes.push_back("bonds by covalent radii, no template for: " + names);
  }
  bool unknown(std::uint32_t i) const { return residue_of(i).kind == ResidueKind::other; }

  void finish() {
    std::sort(s_.bonds.begin(), s_.bonds.end(),
              [](const Bond& a, const Bond& b) { return std::pair(a.first, a.second) < std::pair(b.first, b.second); });
  }

  Structure& s_;
  const std::vector<Vec3>& x_;
  std::set<std::uint64_t> seen_;
  std::map<std::string, int> untabled_;
  std::set<std::string> extended_;  // residues with atoms their template does not have
};

}  // namespace

double covalent_radius(const std::string& element) noexcept {
  static constexpr std::array<std::pair<std::string_view, double>, 33> table{{
      {"H", 0.31},  {"B", 0.84},  {"C", 0.76},  {"N", 0.71},  {"O", 0.66},  {"F", 0.57},  {"Na", 1.66},
      {"Mg", 1.41}, {"Al", 1.21}, {"Si", 1.11}, {"P", 1.07},  {"S", 1.05},  {"Cl", 1.02}, {"K", 2.03},
      {"Ca", 1.76}, {"V", 1.53},  {"Cr", 1.39}, {"Mn", 1.39}, {"Fe", 1.32}, {"Co", 1.26}, {"Ni", 1.24},
      {"Cu", 1.32}, {"Zn", 1.22}, {"As", 1.19}, {"Se", 1.20}, {"Br", 1.20}, {"Mo", 1.54}, {"Ag", 1.45},
      {"Cd", 1.44}, {"I", 1.39},  {"Pt", 1.36}, {"Au", 1.36}, {"Hg", 1.32},
  }};
  for (const auto& [symbol, radius] : table)
    if (symbol == element) return radius;
  return 1.5;  // the middle of the heavier metals, of which no structure here has many
}

void perceive_bonds(Structure& structure) {
  structure.bonds.clear();
  Perception(structure).run();
}

}  // namespace hinge::molecular
