// SPDX-License-Identifier: BSD-3-Clause
// Fits torsions and placements to coordinates, by dihedral angles and by least-squares superposition.
#include "hinge/molecular/fit_torsions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "hinge/core/error.hpp"
#include "hinge/detail/core/elementary.hpp"
#include "motion/superpose.hpp"

namespace hinge::molecular {

namespace {

constexpr double whole_turn = 2.0 * std::numbers::pi;

}  // namespace

double turn_of(const Molecule& molecule, std::size_t k, std::span<const Vec3> positions) {
  const Torsion& torsion = molecule.torsions()[k];
  const auto& a = torsion.atoms;
  const double angle = dihedral(positions[a[0]], positions[a[1]], positions[a[2]], positions[a[3]]);
  if (std::isnan(angle))
    throw LoadError("torsion " + torsion.name + " about " + label(molecule.structure(), a[1]) + " - " +
                    label(molecule.structure(), a[2]) + " is undefined: three of its atoms lie on a line");
  const double difference = std::remainder(angle - torsion.reference, whole_turn);
  return difference == -std::numbers::pi ? std::numbers::pi : difference;
}

std::vector<double> fit_torsions(const Molecule& molecule, const DofSelection& selection,
                                 std::span<const Vec3> positions) {
  std::vector<double> turns;
  turns.reserve(selection.size());
  for (const DofId dof : selection.dofs()) turns.push_back(turn_of(molecule, molecule.torsion_of(dof), positions));
  return turns;
}

void take_shorter_way(std::span<const double> near, std::span<double> turns) {
  for (std::size_t k = 0; k < turns.size(); ++k) turns[k] -= whole_turn * std::round((turns[k] - near[k]) / whole_turn);
}

std::vector<std::array<double, 6>> fit_placements(const Molecule& molecule, std::span<const Vec3> rebuilt,
                                                  std::span<const Vec3> positions, const std::vector<bool>& known) {
  const Structure& s = molecule.structure();
  std::vector<std::vector<bool>> in;
  for (const PlacedPart& placed : molecule.placed_parts()) in.push_back(atoms_in(s, placed.part));
  std::vector<Vec3> moved, onto;
  const auto gather = [&](const auto& wanted) {
    moved.clear();
    onto.clear();
    for (std::size_t i = 0; i < s.atoms.size(); ++i) {
      if (!wanted(i) || (!known.empty() && !known[i])) continue;
      moved.push_back(rebuilt[i]);
      onto.push_back(positions[i]);
    }
    return !moved.empty();
  };
  // Transform from the frame of `positions` to the frame of the atoms that are not placed, which stay fixed.
  Mat3 back = Mat3::Identity();
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  if (gather([&](std::size_t i) {
        return std::none_of(in.begin(), in.end(), [&](const auto& part) { return part[i]; });
      })) {
    from = centre(onto);
    to = centre(moved);
    back = closest_rotation(onto, from, moved, to);
  }
  std::vector<std::array<double, 6>> all;
  for (std::size_t k = 0; k < in.size(); ++k) {
    if (!gather([&](std::size_t i) { return in[k][i]; })) {
      all.push_back({});
      continue;
    }
    for (Vec3& x : onto) x = back * (x - from) + to;
    const Vec3 here = centre(moved), there = centre(onto), c = molecule.placed_parts()[k].centre;
    const Mat3 r = closest_rotation(moved, here, onto, there);
    const Vec3 move = r * (c - here) + there - c;
    // Solves r = Rx(a) Ry(b) Rz(c). Each angle is computed after the previous rotations are removed, so b = pi/2 needs
    // no special case.
    const double a = detail::atan2(-r(1, 2), r(2, 2));
    const auto [sin, cos] = detail::sincos(a);
    const double b = detail::atan2(r(0, 2), cos * r(2, 2) - sin * r(1, 2));
    const double turn = detail::atan2(cos * r(1, 0) + sin * r(2, 0), cos * r(1, 1) + sin * r(2, 1));
    all.push_back({move[0], move[1], move[2], a, b, turn});
  }
  return all;
}

Superposition superpose(std::span<const Vec3> moved, std::span<const Vec3> onto) {
  const Vec3 from = centre(moved), to = centre(onto);
  const Mat3 rotation = closest_rotation(moved, from, onto, to);
  Superposition found;
  double sum = 0.0;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const double squared = squared_norm(Vec3(rotation * (moved[i] - from) + to - onto[i]));
    sum += squared;
    if (squared > found.farthest * found.farthest) {
      found.farthest = std::sqrt(squared);
      found.atom = static_cast<std::uint32_t>(i);
    }
  }
  found.rmsd = std::sqrt(sum / static_cast<double>(moved.size()));
  return found;
}

}  // namespace hinge::molecular
