// SPDX-License-Identifier: BSD-3-Clause
// Random atoms by family: ties to the last bit, scales and positions where rounding matters, and invalid input.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "robustness/case.hpp"
#include "robustness/exact_atoms.hpp"
#include "robustness/family.hpp"

namespace hinge::test {

using AtomFamily = Family<robustness::Atoms>;

/// Returns atoms at these points: one type, one group per atom.
inline robustness::Atoms atoms_at(const std::vector<Vec3>& points, double threshold) {
  robustness::Atoms atoms;
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (const double x : points[k]) atoms.x.push_back(x);
    atoms.type.push_back(0);
    atoms.group.push_back(static_cast<std::int64_t>(k));
  }
  atoms.count = static_cast<std::int64_t>(points.size());
  atoms.type_count = 1;
  atoms.thresholds = {threshold};
  return atoms;
}

/// Returns x or one of the doubles next to it.
inline double neighbour(Random& r, double x) {
  const std::size_t k = r.below(3);
  return k == 0 ? x : std::nextafter(x, k == 1 ? 0.0 : std::numeric_limits<double>::infinity());
}

/// Returns two points with a threshold equal to their rounded distance or one double next to it.
inline robustness::Atoms nearly_tied(Random& r, const Vec3& p, const Vec3& q) {
  return atoms_at({p, q}, neighbour(r, std::sqrt(squared_norm(Vec3(p - q)))));
}

/// Returns a point with integer coordinates in [-below, below).
inline Vec3 whole_point(Random& r, std::size_t below) {
  Vec3 p;
  for (double& x : p) x = static_cast<double>(r.below(2 * below)) - static_cast<double>(below);
  return p;
}

/// A vector and its exact length.
struct WholeLength {
  Vec3 v = Vec3::Zero();
  double length = 0.0;
};

/// Returns an integer vector whose length is an integer.
inline WholeLength whole_length(Random& r) {
  static constexpr std::array<std::array<double, 4>, 9> all{{{1, 2, 2, 3},
                                                             {2, 3, 6, 7},
                                                             {1, 4, 8, 9},
                                                             {4, 4, 7, 9},
                                                             {2, 6, 9, 11},
                                                             {6, 6, 7, 11},
                                                             {3, 4, 12, 13},
                                                             {2, 5, 14, 15},
                                                             {2, 10, 11, 15}}};
  const auto& one = all[r.below(all.size())];
  const auto turn = static_cast<int>(r.below(3));
  WholeLength w;
  for (int k = 0; k < 3; ++k)
    w.v[(k + turn) % 3] = r.one_in(2) ? one[static_cast<std::size_t>(k)] : -one[static_cast<std::size_t>(k)];
  w.length = one[3];
  return w;
}

/// Returns a pair at an integer distance times a power of two, with a threshold at or next to it.
inline robustness::Atoms exact_tie_binary(Random& r) {
  const WholeLength w = whole_length(r);
  const double unit = std::ldexp(1.0, static_cast<int>(r.below(40)) - 20);
  const Vec3 p = whole_point(r, 1 << 20) * unit;
  return atoms_at({p, Vec3(p + w.v * unit)}, neighbour(r, w.length * unit));
}

/// Returns a pair for which plain double arithmetic gives the wrong verdict; any pair after 64 failed attempts.
inline robustness::Atoms double_rounding_flip(Random& r) {
  robustness::Atoms atoms;
  for (int attempt = 0; attempt < 64; ++attempt) {
    const Vec3 p = r.vector(r.one_in(2) ? 100.0 : 1e4), q = p + r.vector(2.0);
    atoms = nearly_tied(r, p, q);
    const double m = atoms.thresholds[0];
    if ((squared_norm(Vec3(p - q)) < m * m) != exactly_closer(p.data(), q.data(), m)) break;
  }
  return atoms;
}

/// Returns a tie in thousandths, as in PDB files; the stored doubles decide it.
inline robustness::Atoms float_flip_pdb_grid(Random& r) {
  const WholeLength w = whole_length(r);
  const double times = static_cast<double>(100 + r.below(300));
  const Vec3 p = whole_point(r, 100'000), q = p + w.v * times;
  return atoms_at({Vec3(p / 1000.0), Vec3(q / 1000.0)}, w.length * times / 1000.0);
}

inline robustness::Atoms coincident(Random& r) {
  constexpr std::array<double, 5> thresholds{0.0, 0x1p-1074, 0x1p-58, 1.0, 0x1p600};
  const Vec3 p = whole_point(r, 1 << 10) * std::ldexp(1.0, static_cast<int>(r.below(100)) - 50);
  return atoms_at(std::vector<Vec3>(2 + r.below(2), p), thresholds[r.below(thresholds.size())]);
}

inline robustness::Atoms far_from_origin(Random& r) {
  const Vec3 p = r.vector(1.0).normalized() * std::pow(10.0, r.uniform(4.0, 11.0));
  return nearly_tied(r, p, Vec3(p + r.vector(3.0)));
}

/// Returns ties at scales where squared lengths overflow, underflow or lose bits.
inline robustness::Atoms tied_at(Random& r, int lowest, int highest) {
  const WholeLength w = whole_length(r);
  const double unit =
      std::ldexp(1.0, lowest + static_cast<int>(r.below(static_cast<std::size_t>(highest - lowest) + 1)));
  const Vec3 p = r.one_in(2) ? Vec3(Vec3::Zero()) : Vec3(whole_point(r, 1 << 10) * unit);
  std::vector<Vec3> points{p, Vec3(p + w.v * unit)};
  if (r.one_in(3)) points.emplace_back(whole_point(r, 1 << 10) * unit);
  return atoms_at(points, neighbour(r, w.length * unit));
}

inline robustness::Atoms lattice_ties(Random& r) {
  const std::size_t side = 3 + r.below(2);
  const double spacing =
      static_cast<double>(1 + r.below(1 << 20)) * std::ldexp(1.0, static_cast<int>(r.below(40)) - 30);
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < side * side * side; ++k) {
    const std::size_t layer = k / side / side;
    points.emplace_back(
        Vec3(static_cast<double>(k % side), static_cast<double>(k / side % side), static_cast<double>(layer)) *
        spacing);
  }
  auto atoms = atoms_at(points, neighbour(r, spacing));
  if (r.one_in(3))
    for (auto& group : atoms.group) group = static_cast<std::int64_t>(r.below(2));
  return atoms;
}

inline robustness::Atoms all_at_one_point(Random& r) {
  return atoms_at(std::vector<Vec3>(1 + r.below(40), r.vector(1e3)), r.one_in(2) ? 0.0 : 1.0);
}

/// Returns points evenly spaced on a line, or each at half the previous point's distance from the origin.
inline robustness::Atoms on_a_line(Random& r) {
  const bool halving = r.one_in(2);
  const double step = r.one_in(2) ? 1.5 : 1.0;
  std::vector<Vec3> points;
  for (int k = 0; k < 40; ++k) points.emplace_back(Vec3(1, 1, 0) * (halving ? std::ldexp(step, -k) : step * k));
  return atoms_at(points, r.one_in(2) ? 1.5 : neighbour(r, std::sqrt(2.0) * step));
}

/// Sets random types, thresholds, groups and exclusions.
inline void mix(Random& r, robustness::Atoms& atoms, std::size_t groups, double largest) {
  atoms.type_count = 1 + static_cast<std::int64_t>(r.below(3));
  const auto types = static_cast<std::size_t>(atoms.type_count);
  atoms.thresholds.assign(types * types, 0.0);
  for (std::size_t s = 0; s < types; ++s)
    for (std::size_t t = 0; t <= s; ++t)
      atoms.thresholds[s * types + t] = atoms.thresholds[t * types + s] = r.one_in(6) ? 0.0 : r.uniform(0.0, largest);
  for (auto& type : atoms.type) type = static_cast<std::int64_t>(r.below(types));
  for (auto& group : atoms.group) group = static_cast<std::int64_t>(r.below(groups));
  for (std::int64_t k = 0; k + 1 < atoms.count; ++k)
    if (!r.one_in(3)) atoms.excluded.insert(atoms.excluded.end(), {k, k + 1});
}

/// Returns no atom, one atom, or many atoms in one group, few groups, or one group each.
inline robustness::Atoms group_extremes(Random& r) {
  const std::size_t n = r.one_in(3) ? r.below(2) : 20;
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < n; ++k) points.push_back(r.vector(3.0));
  auto atoms = atoms_at(points, 1.0);
  const auto own = atoms.group;
  mix(r, atoms, 1 + r.below(4), 2.0);
  if (r.one_in(2)) atoms.group = own;
  return atoms;
}

inline robustness::Atoms random_protein_like(Random& r) {
  std::vector<Vec3> points;
  Vec3 at = r.vector(50.0);
  for (int k = 0; k < 60; ++k) points.emplace_back(at += r.vector(1.0).normalized() * 1.5);
  auto atoms = atoms_at(points, 0.0);
  mix(r, atoms, 1, 3.0);
  for (std::size_t k = 0; k < points.size(); ++k) atoms.group[k] = static_cast<std::int64_t>(k / 6);
  return atoms;
}

inline robustness::Atoms atoms_to_refuse(Random& r) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  auto atoms = atoms_at({Vec3(0, 0, 0), r.vector(3.0), r.vector(3.0)}, 2.0);
  atoms.type_count = 2;
  atoms.thresholds = {2.0, 2.5, 2.5, 3.0};
  switch (r.below(11)) {
    case 0: atoms.x[r.below(9)] = nan; break;
    case 1: atoms.x[r.below(9)] = r.one_in(2) ? infinity : -infinity; break;
    case 2: atoms.thresholds[r.below(4)] = nan; break;
    case 3: atoms.thresholds[r.below(4)] = infinity; break;
    case 4: atoms.thresholds[r.one_in(2) ? 0 : 3] = -r.uniform(0.1, 1.0); break;
    case 5: atoms.thresholds[1] = std::nextafter(2.5, 3.0); break;
    case 6: atoms.thresholds.pop_back(); break;
    case 7: atoms.x.pop_back(); break;
    case 8: atoms.type[r.below(3)] = r.one_in(2) ? 2 : -1; break;
    case 9: atoms.excluded = {1, 1}; break;
    default: atoms.excluded = {0, r.one_in(2) ? 3 : -1}; break;
  }
  return atoms;
}

inline const std::vector<AtomFamily>& atom_families() {
  static const std::vector<AtomFamily> all{{"exact_tie_binary", exact_tie_binary},
                                           {"double_rounding_flip", double_rounding_flip},
                                           {"float_flip_pdb_grid", float_flip_pdb_grid},
                                           {"coincident", coincident},
                                           {"far_from_origin", far_from_origin},
                                           {"denormal", [](Random& r) { return tied_at(r, -1074, -1040); }},
                                           {"huge_coordinates", [](Random& r) { return tied_at(r, 500, 980); }},
                                           {"squared_underflow", [](Random& r) { return tied_at(r, -1000, -530); }},
                                           {"lattice_ties", lattice_ties},
                                           {"all_at_one_point", all_at_one_point},
                                           {"on_a_line", on_a_line},
                                           {"group_extremes", group_extremes},
                                           {"random_protein_like", random_protein_like},
                                           {"must_refuse", atoms_to_refuse, true}};
  return all;
}

}  // namespace hinge::test
