// SPDX-License-Identifier: BSD-3-Clause
// rotation_of_rpy: the rotation of URDF's roll, pitch and yaw.
#pragma once

#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/joint.hpp"

namespace hinge::robotics {

/// Returns the rotation by roll about x, then pitch about y, then yaw about z, all fixed axes (URDF). rpy: rad, finite.
inline Mat3 rotation_of_rpy(const Vec3& rpy) noexcept {
  const Mat3 roll = rotation_about(Vec3::UnitX(), rpy[0]);
  const Mat3 pitch = rotation_about(Vec3::UnitY(), rpy[1]);
  const Mat3 yaw = rotation_about(Vec3::UnitZ(), rpy[2]);
  return product(yaw, product(pitch, roll));
}

}  // namespace hinge::robotics
