// SPDX-License-Identifier: BSD-3-Clause
// Dihedral angles against the reference's, and Eigen's Umeyama.
#include "hinge/molecular/fit_turns.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "hinge/core/error.hpp"

namespace hinge::molecular {

namespace {

constexpr double whole_turn = 2.0 * std::numbers::pi;

Eigen::Matrix3Xd columns(std::span<const Vec3> positions) {
  Eigen::Matrix3Xd m(3, static_cast<Eigen::Index>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (int k = 0; k < 3; ++k) m(k, static_cast<Eigen::Index>(i)) = positions[i][k];
  return m;
}

}  // namespace

std::vector<double> fit_turns(const Molecule& molecule, const DofSelection& selection,
                              std::span<const Vec3> positions) {
  std::vector<double> turns;
  turns.reserve(selection.size());
  for (const DofId dof : selection.dofs()) {
    const Torsion& torsion = molecule.torsions()[molecule.torsion_of(dof)];
    const auto& a = torsion.atoms;
    const double angle = dihedral(positions[a[0]], positions[a[1]], positions[a[2]], positions[a[3]]);
    if (std::isnan(angle))
      throw LoadError("torsion " + torsion.name + " about " + label(molecule.structure(), a[1]) + " - " +
                      label(molecule.structure(), a[2]) + " is undefined: three of its atoms lie on a line");
    const double difference = std::remainder(angle - torsion.reference, whole_turn);
    turns.push_back(difference == -std::numbers::pi ? std::numbers::pi : difference);
  }
  return turns;
}

void take_shorter_way(std::span<const double> near, std::span<double> turns) {
  for (std::size_t k = 0; k < turns.size(); ++k) turns[k] -= whole_turn * std::round((turns[k] - near[k]) / whole_turn);
}

Superposition superpose(std::span<const Vec3> moved, std::span<const Vec3> onto) {
  const Eigen::Matrix3Xd x = columns(moved), y = columns(onto);
  const Eigen::Matrix4d motion = Eigen::umeyama(x, y, false);
  const Eigen::Matrix3d rotation = motion.topLeftCorner<3, 3>();
  const Eigen::Vector3d shift = motion.topRightCorner<3, 1>();
  Superposition found;
  double sum = 0.0;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const double squared = (rotation * x.col(i) + shift - y.col(i)).squaredNorm();
    sum += squared;
    if (squared > found.farthest * found.farthest) {
      found.farthest = std::sqrt(squared);
      found.atom = static_cast<std::uint32_t>(i);
    }
  }
  found.rmsd = std::sqrt(sum / static_cast<double>(x.cols()));
  return found;
}

}  // namespace hinge::molecular
