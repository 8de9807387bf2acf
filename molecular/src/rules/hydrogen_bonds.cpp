// SPDX-License-Identifier: BSD-3-Clause
// Finds the backbone hydrogen bonds of Kabsch and Sander, Biopolymers 22:2577 (1983), as DSSP does.
#include "rules/hydrogen_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "chemistry/cell_grid.hpp"
#include "chemistry/residue_table.hpp"

namespace hinge::molecular {

namespace {

constexpr double weakest = -0.5;                  // kcal/mol; a bond needs a lower energy
constexpr double strength = 0.42 * 0.20 * 332.0;  // two partial charges (e) times the Coulomb constant, kcal A/mol
/// Largest distance from N to O (angstrom) at which the energy can be below `weakest`. H is 1 A from N and C at most
/// 1.3 A from O, so E > -27.9 * (1/(r - 1) - 1/r + 1/(r - 1.3) - 1/r) > -0.5 for r >= 12 A.
constexpr double largest_n_to_o = 12.0;
/// Smaller distances (angstrom) are raised to this value, as in DSSP.
constexpr double nearest = 0.5;

}  // namespace

std::vector<HydrogenBond> find_hydrogen_bonds(const Structure& s) {
  const std::vector<Vec3>& x = s.models.front();
  const auto find = [&](std::uint32_t r, std::string_view name) -> std::optional<std::uint32_t> {
    for (std::uint32_t i = s.residues[r].first_atom; i < s.residues[r].last_atom; ++i)
      if (s.atoms[i].name == name) return i;
    return std::nullopt;
  };
  struct Carbonyl {
    std::uint32_t carbon, oxygen;
  };
  std::vector<std::optional<Carbonyl>> carbonyl(s.residues.size()), before(s.residues.size());
  std::vector<std::uint32_t> oxygens;
  for (std::uint32_t r = 0; r < s.residues.size(); ++r) {
    if (s.residues[r].kind != ResidueKind::amino_acid) continue;
    const auto c = find(r, "C"), o = find(r, "O");
    if (!c || !o) continue;
    carbonyl[r] = Carbonyl{*c, *o};
    oxygens.push_back(*o);
  }
  for (const Bond& bond : s.bonds) {
    if (bond.origin != BondOrigin::peptide) continue;
    const bool first_is_c = s.atoms[bond.first].name == "C";
    const std::uint32_t c = first_is_c ? bond.first : bond.second, n = first_is_c ? bond.second : bond.first;
    before[s.atoms[n].residue] = carbonyl[s.atoms[c].residue];
  }
  const CellGrid grid(x, oxygens, largest_n_to_o);
  const auto inverse = [](const Vec3& a, const Vec3& b) { return 1.0 / std::max(norm(Vec3(a - b)), nearest); };
  std::vector<HydrogenBond> bonds;
  for (std::uint32_t r = 0; r < s.residues.size(); ++r) {
    const auto n = find(r, "N");
    const ResidueTemplate* known = find_residue_template(s.residues[r].name);
    if (!n || !before[r] || (known != nullptr && known->letter == 'P')) continue;
    const Vec3 along = x[before[r]->carbon] - x[before[r]->oxygen];
    const double length = norm(along);
    if (!(length > 0.0)) continue;
    const Vec3 h = x[*n] + along / length;
    HydrogenBond best{*n, 0, weakest};
    grid.for_each_near(x[*n], [&](std::uint32_t o) {
      const std::uint32_t t = s.atoms[o].residue;
      if (t == r || t == s.atoms[before[r]->carbon].residue || (before[t] && s.atoms[before[t]->carbon].residue == r))
        return;
      const Vec3& c = x[carbonyl[t]->carbon];
      const double energy = strength * (inverse(x[o], x[*n]) + inverse(c, h) - inverse(x[o], h) - inverse(c, x[*n]));
      if (energy < best.energy || (energy == best.energy && energy < weakest && o < best.oxygen))
        best = {*n, o, energy};
    });
    if (best.energy < weakest) bonds.push_back(best);
  }
  std::sort(bonds.begin(), bonds.end(),
            [](const HydrogenBond& a, const HydrogenBond& b) { return a.nitrogen < b.nitrogen; });
  return bonds;
}

}  // namespace hinge::molecular
