// SPDX-License-Identifier: BSD-3-Clause
// Displacement: how far all atoms are from where they started.
#pragma once

#include <span>
#include <vector>

#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/molecular/checker.hpp"

namespace hinge::molecular {

/// The sum of the squared displacements of all atoms between a start and another conformation. An evaluation takes time
/// in proportion to the number of rigid groups.
class Displacement {
 public:
  /// The checker must outlive this object. start: one value per selected DOF.
  Displacement(const Checker& checker, std::span<const double> start);

  /// Returns weight * (the sum at q, square angstrom) and adds its derivatives by q to `gradient`.
  double add(double weight, std::span<const double> q, std::span<double> gradient) const;

 private:
  /// The atoms of a rigid group, in its frame.
  struct Body {
    double count = 0.0;
    Vec3 centre = Vec3::Zero();
    Mat3 second = Mat3::Zero();  ///< sum of y yᵀ, y: from the centre to an atom
  };

  const RigidGroups& groups_;
  std::vector<Body> bodies_;
  std::vector<Pose> start_;
};

}  // namespace hinge::molecular
