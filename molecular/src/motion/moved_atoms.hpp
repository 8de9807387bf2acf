// SPDX-License-Identifier: BSD-3-Clause
// find_moved_atoms: how far the values of a configuration move the atoms of a molecule.
#pragma once

#include <span>
#include <vector>

#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/molecular/checker.hpp"

namespace hinge::molecular {

/// The atoms that one value of a configuration moves.
struct MovedAtoms {
  double lever = 1.0;       ///< root of the moment of inertia (angstrom per rad), or of the number of atoms for slides
  double root_count = 1.0;  ///< root of the number of atoms
  bool in_one_residue = false;  ///< they all belong to one residue
};

/// Returns one entry per value, for the conformation q. Leaves the checker there.
std::vector<MovedAtoms> find_moved_atoms(Checker& checker, std::span<const double> q);

/// Returns the pose of every rigid group at q.
std::vector<Pose> group_poses(const RigidGroups& groups, std::span<const double> q);

/// Returns the position of every atom in the frame of its rigid group.
std::vector<Vec3> positions_in_groups(const Checker& checker);

/// Returns the derivatives of a function of the atoms' positions by the values of a configuration. poses:
/// group_poses(). force, moment: per group the sums over its atoms of dE/dx and of (x - centre) cross dE/dx; changed.
std::vector<double> gradient_by_values(const RigidGroups& groups, std::span<const Pose> poses, const Vec3& centre,
                                       std::vector<Vec3>& force, std::vector<Vec3>& moment, std::size_t count);

}  // namespace hinge::molecular
