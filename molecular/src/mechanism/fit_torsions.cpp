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

namespace hinge::molecular {

namespace {

constexpr double whole_turn = 2.0 * std::numbers::pi;

Vec3 centre(std::span<const Vec3> positions) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& position : positions) sum += position;
  return sum / static_cast<double>(positions.size());
}

using Quaternion = std::array<double, 4>;

/// Returns the eigenvector of the largest eigenvalue of a symmetric matrix, by Jacobi's rotations (Golub & Van Loan,
/// Matrix Computations, section 8.5). Only scalars, in a fixed order: the bits are the same for every instruction set.
Quaternion largest_eigenvector(std::array<Quaternion, 4> n) {
  std::array<Quaternion, 4> vectors{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};  // in columns
  constexpr int most_sweeps = 30;  // five are usual: convergence is quadratic
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double off = 0.0, scale = 0.0;
    for (std::size_t p = 0; p < 4; ++p)
      for (std::size_t q = 0; q < 4; ++q) (p == q ? scale : off) += std::abs(n[p][q]);
    if (!(off > 0x1p-60 * scale)) break;
    for (std::size_t p = 0; p < 3; ++p)
      for (std::size_t q = p + 1; q < 4; ++q) {
        if (n[p][q] == 0.0) continue;
        const double tau = (n[q][q] - n[p][p]) / (2.0 * n[p][q]);
        const double t = std::copysign(1.0, tau) / (std::abs(tau) + std::sqrt(1.0 + tau * tau));
        const double c = 1.0 / std::sqrt(1.0 + t * t), s = t * c;
        const auto rotate = [&](double& a, double& b) {
          const double old = a;
          a = c * old - s * b;
          b = s * old + c * b;
        };
        for (std::size_t k = 0; k < 4; ++k) rotate(n[k][p], n[k][q]);
        for (std::size_t k = 0; k < 4; ++k) rotate(n[p][k], n[q][k]);
        for (Quaternion& row : vectors) rotate(row[p], row[q]);
        n[p][q] = n[q][p] = 0.0;
      }
  }
  std::size_t largest = 0;
  for (std::size_t k = 1; k < 4; ++k)
    if (n[k][k] > n[largest][largest]) largest = k;
  return {vectors[0][largest], vectors[1][largest], vectors[2][largest], vectors[3][largest]};
}

/// Returns the least-squares rotation from `moved` to `onto`, each relative to its centre: the quaternion of the
/// largest eigenvalue (Horn, J. Opt. Soc. Am. A 4:629, 1987).
Mat3 closest_rotation(std::span<const Vec3> moved, const Vec3& centre_moved, std::span<const Vec3> onto,
                      const Vec3& centre_onto) {
  double m[3][3] = {};
  for (std::size_t i = 0; i < moved.size(); ++i)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) m[r][c] += (moved[i][r] - centre_moved[r]) * (onto[i][c] - centre_onto[c]);
  auto [w, x, y, z] =
      largest_eigenvector({{{m[0][0] + m[1][1] + m[2][2], m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]},
                            {m[1][2] - m[2][1], m[0][0] - m[1][1] - m[2][2], m[0][1] + m[1][0], m[2][0] + m[0][2]},
                            {m[2][0] - m[0][2], m[0][1] + m[1][0], m[1][1] - m[0][0] - m[2][2], m[1][2] + m[2][1]},
                            {m[0][1] - m[1][0], m[2][0] + m[0][2], m[1][2] + m[2][1], m[2][2] - m[0][0] - m[1][1]}}});
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  w /= length, x /= length, y /= length, z /= length;
  Mat3 rotation;
  rotation << 1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y),  //
      2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x),          //
      2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y);
  return rotation;
}

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
                                                  std::span<const Vec3> positions) {
  const Structure& s = molecule.structure();
  std::vector<std::vector<bool>> in;
  for (const PlacedPart& placed : molecule.placed_parts()) in.push_back(atoms_in(s, placed.part));
  std::vector<Vec3> moved, onto;
  const auto gather = [&](const auto& wanted) {
    moved.clear();
    onto.clear();
    for (std::size_t i = 0; i < s.atoms.size(); ++i) {
      if (!wanted(i)) continue;
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
    gather([&](std::size_t i) { return in[k][i]; });
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
