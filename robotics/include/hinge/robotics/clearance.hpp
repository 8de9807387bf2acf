// SPDX-License-Identifier: BSD-3-Clause
// Clearances: distances of pairs of links and bodies with witness points, normals and derivatives.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/robotics/contact.hpp"

namespace hinge::robotics {

/// Derivatives of distances: one row per pair, one column per independent joint, m per rad or m per m. Not aligned: the
/// alignment of Eigen depends on the instruction set, and the library may be compiled for another one than its user.
using ClearanceJacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor | Eigen::DontAlign>;

/// A distance with its witness points, m, world frame.
struct Clearance {
  /// Distance of the surfaces. Negative, if is_signed, by the depth to which spheres or capsules overlap.
  double distance = 0.0;
  double gap = 0.0;            ///< distance minus the clearance that the pair must keep
  Vec3 point1 = Vec3::Zero();  ///< on the surface of the first one
  Vec3 point2 = Vec3::Zero();  ///< on the surface of the second one
  /// Unit vector from the first to the second, in which the distance grows. Zero if the pair has no direction: meshes
  /// that meet, axes of capsules that meet, or one inside a solid of the other; the distance is then 0.
  Vec3 normal = Vec3::Zero();
  /// True for pairs of triangles that a sphere or capsule inflates, as long as the axes are apart: the distance goes
  /// on below 0. Meshes alone have no depth: their distance ends at 0.
  bool is_signed = false;
};

/// The clearance of two links of a robot.
struct LinkClearance : Clearance {
  LinkId link1{};  ///< link1 < link2
  LinkId link2{};  ///< the other link
};

/// The clearance of a link (or a body that it holds) and a body of an environment.
struct BodyClearance : Clearance {
  LinkId link{};                        ///< the link, or the link that holds `held`
  std::optional<BodyId> held{};         ///< the attached body; empty: the link itself
  BodyId body{};                        ///< the other side
  std::optional<LinkId> body_holder{};  ///< the link of this robot that holds `body`; empty: none, it stands still
};

}  // namespace hinge::robotics
