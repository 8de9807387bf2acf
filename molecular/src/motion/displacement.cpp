// SPDX-License-Identifier: BSD-3-Clause
// Sums over rigid groups instead of atoms: a group's displacements are those of its centre and of its turn about it.
#include "motion/displacement.hpp"

#include <cstddef>
#include <cstdint>

#include "motion/moved_atoms.hpp"

namespace hinge::molecular {

Displacement::Displacement(const Checker& checker, std::span<const double> start)
    : groups_(checker.rigid_groups()), bodies_(groups_.size()), start_(group_poses(groups_, start)) {
  const std::vector<Vec3> local = positions_in_groups(checker);
  const auto body_of = [&](std::size_t atom) -> Body& {
    return bodies_[index(checker.group_of(static_cast<std::uint32_t>(atom)))];
  };
  for (std::size_t atom = 0; atom < local.size(); ++atom) {
    body_of(atom).count += 1.0;
    body_of(atom).centre += local[atom];
  }
  for (Body& body : bodies_)
    if (body.count > 0.0) body.centre /= body.count;
  for (std::size_t atom = 0; atom < local.size(); ++atom) {
    Body& body = body_of(atom);
    const Vec3 y = local[atom] - body.centre;
    body.second += y * y.transpose();
  }
}

double Displacement::add(double weight, std::span<const double> q, std::span<double> gradient) const {
  const std::vector<Pose> poses = group_poses(groups_, q);
  const Vec3 origin = start_.back().translation;  // near the molecule, so that moments keep their digits
  std::vector<Vec3> force(groups_.size(), Vec3::Zero()), moment(groups_.size(), Vec3::Zero());
  double sum = 0.0;
  for (std::size_t g = 1; g < groups_.size(); ++g) {
    const Body& body = bodies_[g];
    const Vec3 centre = poses[g] * body.centre, shift = centre - start_[g] * body.centre;
    const Mat3 turn = poses[g].rotation - start_[g].rotation;
    const Mat3 turned = product(turn, body.second);
    sum += body.count * squared_norm(shift);
    for (int k = 0; k < 3; ++k) sum += dot(Vec3(turned.col(k)), Vec3(turn.col(k)));
    // The sum of (R y) (turn y)ᵀ holds the components of the sum of (R y) cross (turn y).
    const Mat3 arms = product(poses[g].rotation, Mat3(turned.transpose()));
    const Vec3 twist(arms(1, 2) - arms(2, 1), arms(2, 0) - arms(0, 2), arms(0, 1) - arms(1, 0));
    force[g] = 2.0 * weight * body.count * shift;
    moment[g] = cross(Vec3(centre - origin), force[g]) + 2.0 * weight * twist;
  }
  const std::vector<double> slopes = gradient_by_values(groups_, poses, origin, force, moment, q.size());
  for (std::size_t k = 0; k < gradient.size(); ++k) gradient[k] += slopes[k];
  return weight * sum;
}

}  // namespace hinge::molecular
