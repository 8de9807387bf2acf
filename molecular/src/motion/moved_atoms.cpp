// SPDX-License-Identifier: BSD-3-Clause
// Sums over the atoms that each value moves, from the outermost groups to the root.
#include "motion/moved_atoms.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hinge::molecular {

std::vector<Pose> group_poses(const RigidGroups& groups, std::span<const double> q) {
  std::vector<Pose> poses(groups.size());
  for (std::size_t g = 1; g < groups.size(); ++g) {
    const RigidGroup& group = groups[id<GroupId>(g)];
    poses[g] = poses[index(group.parent)] * group.joint.origin * motion(group.joint, q[group.dof]);
  }
  return poses;
}

std::vector<Vec3> positions_in_groups(const Checker& checker) {
  const std::vector<double> reference(checker.dof_count(), 0.0);
  const std::vector<Pose> poses = group_poses(checker.rigid_groups(), reference);
  std::vector<Vec3> positions = checker.molecule().structure().models.front();
  for (std::uint32_t atom = 0; atom < positions.size(); ++atom) {
    const Pose& pose = poses[index(checker.group_of(atom))];
    positions[atom] = product(Mat3(pose.rotation.transpose()), Vec3(positions[atom] - pose.translation));
  }
  return positions;
}

std::vector<double> gradient_by_values(const RigidGroups& groups, std::span<const Pose> poses, const Vec3& centre,
                                       std::vector<Vec3>& force, std::vector<Vec3>& moment, std::size_t count) {
  std::vector<double> gradient(count, 0.0);
  for (std::size_t g = groups.size(); g-- > 1;) {
    const RigidGroup& group = groups[id<GroupId>(g)];
    const Vec3 axis = product(poses[g].rotation, group.joint.axis);
    gradient[group.dof] =
        group.joint.kind == JointKind::prismatic
            ? dot(axis, force[g])
            : dot(axis, Vec3(moment[g] - cross(Vec3(poses[g] * group.joint.point - centre), force[g])));
    force[index(group.parent)] += force[g];
    moment[index(group.parent)] += moment[g];
  }
  return gradient;
}

std::vector<MovedAtoms> find_moved_atoms(Checker& checker, std::span<const double> q) {
  const RigidGroups& groups = checker.rigid_groups();
  const Structure& s = checker.molecule().structure();
  checker.check(q, Mode{});
  struct Sums {
    double count = 0.0, squares = 0.0;  // of |x - centre|^2
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    std::uint32_t least_residue = ~0U, largest_residue = 0;
  };
  std::vector<Sums> sums(groups.size());
  const Vec3 centre = checker.position(0);
  for (std::uint32_t atom = 0; atom < s.atoms.size(); ++atom) {
    Sums& own = sums[index(checker.group_of(atom))];
    const Vec3 x = checker.position(atom) - centre;
    own.count += 1.0;
    own.squares += squared_norm(x);
    own.first += x;
    own.second += x * x.transpose();
    own.least_residue = std::min(own.least_residue, s.atoms[atom].residue);
    own.largest_residue = std::max(own.largest_residue, s.atoms[atom].residue);
  }
  const std::vector<Pose> poses = group_poses(groups, q);
  std::vector<MovedAtoms> moved(q.size());
  for (std::size_t g = groups.size(); g-- > 1;) {
    const RigidGroup& group = groups[id<GroupId>(g)];
    const Sums& own = sums[g];
    const Vec3 axis = product(poses[g].rotation, group.joint.axis);
    const Vec3 p = poses[g] * group.joint.point - centre;
    double inertia = own.count;
    if (group.joint.kind == JointKind::revolute) {
      const double along = dot(axis, p);
      inertia = own.squares - 2.0 * dot(p, own.first) + own.count * squared_norm(p) -
                dot(axis, product(own.second, axis)) + 2.0 * along * dot(axis, own.first) - own.count * along * along;
    }
    // An axis through all atoms that it moves changes nothing; any scale will do.
    if (inertia > 1e-3) moved[group.dof].lever = std::sqrt(inertia);
    if (own.count > 0.0) moved[group.dof].root_count = std::sqrt(own.count);
    moved[group.dof].in_one_residue = own.least_residue >= own.largest_residue;
    Sums& parent = sums[index(group.parent)];
    parent.count += own.count;
    parent.squares += own.squares;
    parent.first += own.first;
    parent.second += own.second;
    parent.least_residue = std::min(parent.least_residue, own.least_residue);
    parent.largest_residue = std::max(parent.largest_residue, own.largest_residue);
  }
  return moved;
}

}  // namespace hinge::molecular
