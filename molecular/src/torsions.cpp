// SPDX-License-Identifier: BSD-3-Clause
// Torsions from names and bonds.
#include "hinge/molecular/torsions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "hinge/molecular/residue_table.hpp"

namespace hinge::molecular {

double dihedral(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  const Vec3 u = b - a, v = c - b, w = d - c;
  const Vec3 m = cross(u, v), n = cross(v, w);
  // A cross product is the rounding of its terms when it is this much smaller than they are.
  const auto undefined = [](const Vec3& product, const Vec3& p, const Vec3& q) {
    return !(squared_norm(product) > 0x1p-90 * squared_norm(p) * squared_norm(q));
  };
  if (undefined(m, u, v) || undefined(n, v, w)) return std::numeric_limits<double>::quiet_NaN();
  return std::atan2(std::sqrt(squared_norm(v)) * dot(u, n), dot(m, n));
}

namespace {

class Finder {
 public:
  Finder(const Structure& structure, std::vector<std::string>& notes) : s_(structure), notes_(notes) {}

  std::vector<Torsion> run() {
    find_peptide_bonds();
    for (std::uint32_t r = 0; r < s_.residues.size(); ++r)
      if (s_.residues[r].kind == ResidueKind::amino_acid) add_residue(r);
    return std::move(torsions_);
  }

 private:
  using Atom = std::optional<std::uint32_t>;

  /// previous_[r] and next_[r]: residues joined to r by a peptide bond.
  void find_peptide_bonds() {
    previous_.resize(s_.residues.size());
    next_.resize(s_.residues.size());
    for (const Bond& bond : s_.bonds) {
      if (bond.origin != BondOrigin::peptide) continue;
      const bool first_is_c = s_.atoms[bond.first].name == "C";
      const std::uint32_t c = s_.atoms[first_is_c ? bond.first : bond.second].residue;
      const std::uint32_t n = s_.atoms[first_is_c ? bond.second : bond.first].residue;
      next_[c] = n;
      previous_[n] = c;
    }
  }

  Atom find(std::optional<std::uint32_t> residue, std::string_view name) const {
    if (!residue) return std::nullopt;
    for (std::uint32_t i = s_.residues[*residue].first_atom; i < s_.residues[*residue].last_atom; ++i)
      if (s_.atoms[i].name == name) return i;
    return std::nullopt;
  }

  void add(std::uint32_t residue, std::string name, Atom a, Atom b, Atom c, Atom d) {
    if (!a || !b || !c || !d) return;
    const auto& x = s_.models.front();
    const double angle = dihedral(x[*a], x[*b], x[*c], x[*d]);
    if (std::isnan(angle)) {
      notes_.push_back("torsion " + name + " of " + label(s_, *b) + " is undefined: three of its atoms lie on a line");
      return;
    }
    torsions_.push_back({residue, std::move(name), {*a, *b, *c, *d}, angle});
  }

  void add_residue(std::uint32_t r) {
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
        if (!atom && name == "CD1") atom = find(r, "CD");  // CHARMM's isoleucine
        names.remove_prefix(std::min(name.size() + 1, names.size()));
      }
      add(r, "chi" + std::to_string(k), atoms[0], atoms[1], atoms[2], atoms[3]);
      chi.remove_prefix(std::min(one.size() + 1, chi.size()));
    }
  }

  const Structure& s_;
  std::vector<std::string>& notes_;
  std::vector<std::optional<std::uint32_t>> previous_, next_;
  std::vector<Torsion> torsions_;
};

}  // namespace

std::vector<Torsion> find_torsions(const Structure& structure, std::vector<std::string>& notes) {
  return Finder(structure, notes).run();
}

}  // namespace hinge::molecular
