// SPDX-License-Identifier: BSD-3-Clause
// Finds torsions by atom names and bonds.
#include "hinge/molecular/torsions.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "chemistry/nucleotide_table.hpp"
#include "chemistry/residue_table.hpp"
#include "hinge/detail/core/elementary.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/bonds.hpp"
#include "mechanism/rotatable_bonds.hpp"

namespace hinge::molecular {

double dihedral(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  const Vec3 u = b - a, v = c - b, w = d - c;
  const Vec3 m = cross(u, v), n = cross(v, w);
  // A cross product this much smaller than its factors consists of rounding errors only.
  const auto undefined = [](const Vec3& product, const Vec3& p, const Vec3& q) {
    return !(squared_norm(product) > 0x1p-90 * squared_norm(p) * squared_norm(q));
  };
  if (undefined(m, u, v) || undefined(n, v, w)) return std::numeric_limits<double>::quiet_NaN();
  return detail::atan2(std::sqrt(squared_norm(v)) * dot(u, n), dot(m, n));
}

namespace {

class Finder {
 public:
  Finder(const Structure& structure, std::vector<std::string>& notes) : s_(structure), notes_(notes) {}

  std::vector<Torsion> run() {
    find_neighbours();
    for (std::uint32_t r = 0; r < s_.residues.size(); ++r) {
      if (s_.residues[r].kind == ResidueKind::amino_acid) add_amino_acid(r);
      if (s_.residues[r].kind == ResidueKind::nucleotide) add_nucleotide(r);
    }
    add_bonds();
    return std::move(torsions_);
  }

 private:
  using Atom = std::optional<std::uint32_t>;

  /// Sets previous_[r] and next_[r]: the residues joined to r by a backbone bond.
  void find_neighbours() {
    previous_.resize(s_.residues.size());
    next_.resize(s_.residues.size());
    for (const Bond& bond : s_.bonds) {
      const bool peptide = bond.origin == BondOrigin::peptide;
      if (!peptide && bond.origin != BondOrigin::phosphodiester) continue;
      const std::string& first = s_.atoms[bond.first].name;
      const bool in_order = peptide ? first == "C" : is_nucleotide_atom(first, "O3'");
      const std::uint32_t before = s_.atoms[in_order ? bond.first : bond.second].residue;
      const std::uint32_t behind = s_.atoms[in_order ? bond.second : bond.first].residue;
      next_[before] = behind;
      previous_[behind] = before;
    }
  }

  Atom find(std::optional<std::uint32_t> residue, std::string_view name) const {
    if (!residue) return std::nullopt;
    const Residue& r = s_.residues[*residue];
    const bool nucleotide = r.kind == ResidueKind::nucleotide;
    for (std::uint32_t i = r.first_atom; i < r.last_atom; ++i)
      if (nucleotide ? is_nucleotide_atom(s_.atoms[i].name, name) : s_.atoms[i].name == name) return i;
    return std::nullopt;
  }
  /// Returns the atom with the first of these names that the residue has.
  Atom find_any(std::uint32_t residue, std::initializer_list<std::string_view> names) const {
    Atom found;
    for (const std::string_view name : names)
      if (!found) found = find(residue, name);
    return found;
  }

  void add(std::uint32_t residue, std::string name, Atom a, Atom b, Atom c, Atom d) {
    if (!a || !b || !c || !d) return;
    named_.insert(std::minmax(*b, *c));
    const auto& x = s_.models.front();
    const double angle = dihedral(x[*a], x[*b], x[*c], x[*d]);
    if (std::isnan(angle)) {
      notes_.push_back("torsion " + name + " of " + label(s_, *b) + " is undefined: three of its atoms lie on a line");
      return;
    }
    torsions_.push_back({residue, std::move(name), {*a, *b, *c, *d}, angle});
  }

  void add_amino_acid(std::uint32_t r) {
    const ResidueTemplate* known = find_residue_template(s_.residues[r].name);
    const Atom n = find(r, "N"), ca = find(r, "CA"), c = find(r, "C");
    const bool proline = known != nullptr && known->letter == 'P';
    if (!proline) add(r, "phi", find(previous_[r], "C"), n, ca, c);
    Atom beyond = find(next_[r], "N");
    if (!beyond) beyond = find(r, "O");
    if (!beyond) beyond = find(r, "OT1");
    add(r, "psi", n, ca, c, beyond);
    add(r, "omega", ca, c, find(next_[r], "N"), find(next_[r], "CA"));
    if (known == nullptr) return;
    std::string_view chi = known->chi;
    for (int k = 1; !chi.empty(); ++k) {
      const std::string_view one = chi.substr(0, chi.find(' '));
      std::array<Atom, 4> atoms;
      std::string_view names = one;
      for (Atom& atom : atoms) {
        const std::string_view name = names.substr(0, names.find('-'));
        atom = find(r, name);
        if (!atom && name == "CD1") atom = find(r, "CD");  // name in CHARMM's isoleucine
        names.remove_prefix(std::min(name.size() + 1, names.size()));
      }
      add(r, "chi" + std::to_string(k), atoms[0], atoms[1], atoms[2], atoms[3]);
      chi.remove_prefix(std::min(one.size() + 1, chi.size()));
    }
  }

  void add_nucleotide(std::uint32_t r) {
    const Atom p = find(r, "P"), o5 = find(r, "O5'"), c5 = find(r, "C5'"), c4 = find(r, "C4'"), c3 = find(r, "C3'");
    const Atom o3 = find(r, "O3'"), c2 = find(r, "C2'"), c1 = find(r, "C1'"), o4 = find(r, "O4'");
    const auto or_else = [](Atom first, Atom second) { return first ? first : second; };
    const Atom before = find(previous_[r], "O3'"), behind = find(next_[r], "P");
    add(r, "alpha", or_else(before, find_any(r, {"OP3", "OP1"})), p, o5, c5);
    add(r, "beta", or_else(p, find_any(r, {"HO5'", "H5T"})), o5, c5, c4);
    add(r, "gamma", o5, c5, c4, c3);
    add(r, "epsilon", c4, c3, o3, or_else(behind, find_any(r, {"HO3'", "H3T"})));
    add(r, "zeta", c3, o3, behind, find(next_[r], "O5'"));
    add_glycosidic(r, o4, c1);
    add(r, "kappa", c1, c2, find(r, "O2'"), find_any(r, {"HO2'", "HO'2", "2HO'"}));
  }

  /// Adds chi: O4' C1' N9 C4 of purines, O4' C1' N1 C2 of pyrimidines, O4' C1' C5 C4 of pseudouridine.
  void add_glycosidic(std::uint32_t r, Atom o4, Atom c1) {
    if (!c1) return;
    for (const auto& [joined, next] : {std::pair("N9", "C4"), std::pair("N1", "C2"), std::pair("C5", "C4")}) {
      const Atom base = find(r, joined);
      if (base && bonded(*c1, *base)) return add(r, "chi", o4, c1, base, find(r, next));
    }
  }

  bool bonded(std::uint32_t i, std::uint32_t j) const {
    const std::pair<std::uint32_t, std::uint32_t> wanted = std::minmax(i, j);
    const auto at = std::lower_bound(s_.bonds.begin(), s_.bonds.end(), wanted, [](const Bond& bond, const auto& pair) {
      return std::pair(bond.first, bond.second) < pair;
    });
    return at != s_.bonds.end() && std::pair(at->first, at->second) == wanted;
  }

  /// Adds the rotatable bonds that have no named torsion. Their atoms give the name, as in "C5-C6". A torsion belongs
  /// to the residue outside the polymer if only one residue is, otherwise to the later residue.
  void add_bonds() {
    const std::vector<Bond> bonds = rotatable_bonds(s_, named_);
    if (bonds.empty()) return;
    const auto neighbours = bonded_neighbours(s_);
    for (const Bond& bond : bonds) {
      const std::uint32_t r = s_.atoms[bond.first].residue, t = s_.atoms[bond.second].residue;
      const bool first = s_.residues[r].kind == ResidueKind::other && s_.residues[t].kind != ResidueKind::other;
      const auto far = [&](std::uint32_t atom, std::uint32_t across) {
        const auto& list = neighbours[atom];
        const auto found = std::find_if(list.begin(), list.end(), [&](std::uint32_t i) {
          return i != across && s_.atoms[i].element != "H" && !is_metal(s_.atoms[i].element);
        });
        return found == list.end() ? Atom() : Atom(*found);
      };
      add(first ? r : t, s_.atoms[bond.first].name + "-" + s_.atoms[bond.second].name, far(bond.first, bond.second),
          bond.first, bond.second, far(bond.second, bond.first));
    }
    std::stable_sort(torsions_.begin(), torsions_.end(),
                     [](const Torsion& a, const Torsion& b) { return a.residue < b.residue; });
  }

  const Structure& s_;
  std::vector<std::string>& notes_;
  AtomPairs named_;
  std::vector<std::optional<std::uint32_t>> previous_, next_;
  std::vector<Torsion> torsions_;
};

}  // namespace

std::string torsion_label(const Structure& structure, const Torsion& torsion) {
  return residue_label(structure, torsion.residue) + ":" + torsion.name;
}

std::vector<Torsion> find_torsions(const Structure& structure, std::vector<std::string>& notes) {
  return Finder(structure, notes).run();
}

}  // namespace hinge::molecular
