// SPDX-License-Identifier: BSD-3-Clause
// Joints: the connection of a link to its parent, and the motion for a given joint value.
#pragma once

#include <array>
#include <string>
#include <utility>

#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/core/sincos.hpp"

namespace hinge {

/// A rigid connection of child and parent.
struct Fixed {
  Pose origin{};  ///< child frame in the parent frame
};

/// The child rotates by q radians about the line through `point` along `axis`.
struct Revolute {
  Vec3 axis = Vec3::UnitZ();  ///< any length except 0, child frame
  Vec3 point = Vec3::Zero();  ///< any point of the line, child frame, model length unit
  Pose origin{};              ///< child frame in the parent frame at q = 0
  std::string name{};         ///< for error messages and output; may be empty
};

/// The child translates by q (model length unit) along `axis`.
struct Prismatic {
  Vec3 axis = Vec3::UnitZ();  ///< any length except 0, child frame
  Pose origin{};              ///< child frame in the parent frame at q = 0
  std::string name{};         ///< for error messages and output; may be empty
};

/// The kind of a joint.
enum class JointKind : unsigned char { fixed, revolute, prismatic };

/// Any of the three kinds. The world pose of the child is T(child) = T(parent) * origin * motion(q).
struct Joint {
  JointKind kind = JointKind::fixed;  ///< selects the motion
  Pose origin{};                      ///< child frame in the parent frame at q = 0
  Vec3 axis = Vec3::UnitZ();          ///< child frame; the tree normalises it to unit length
  Vec3 point = Vec3::Zero();          ///< a point of a revolute axis, child frame, model length unit
  std::string name{};                 ///< for error messages and output; may be empty

  /// A fixed joint with the identity as origin.
  Joint() = default;
  /// Converts one kind. The axis may have any length; KinematicTree::add_link checks and normalises it.
  Joint(Fixed j) : origin(std::move(j.origin)) {}
  /// Converts one kind, as above.
  Joint(Revolute j)
      : kind(JointKind::revolute), origin(j.origin), axis(j.axis), point(j.point), name(std::move(j.name)) {}
  /// Converts one kind, as above.
  Joint(Prismatic j) : kind(JointKind::prismatic), origin(j.origin), axis(j.axis), name(std::move(j.name)) {}

  /// Returns true for revolute and prismatic joints.
  bool has_dof() const noexcept { return kind != JointKind::fixed; }
};

/// Returns the rotation matrix about the unit axis (x, y, z) for an angle with this sine and cosine (Rodrigues), column
/// by column, in a fixed order of operations. T: double, or SIMD lanes of double.
template <class T>
[[gnu::always_inline]] inline std::array<T, 9> rotation_columns(const T& x, const T& y, const T& z, const T& sine,
                                                                const T& cosine) noexcept {
  const T v = T(1.0) - cosine;
  const T xs = x * sine, ys = y * sine, zs = z * sine;
  return {cosine + x * x * v, x * y * v + zs,     x * z * v - ys,  //
          x * y * v - zs,     cosine + y * y * v, y * z * v + xs,  //
          x * z * v + ys,     y * z * v - xs,     cosine + z * z * v};
}

/// Returns the rotation by `angle` (rad) about a unit axis. It is exactly the identity for angle 0.
inline Mat3 rotation_about(const Vec3& axis, double angle) noexcept {
  const detail::SinCos sc = detail::sincos(angle);
  const auto columns = rotation_columns(axis[0], axis[1], axis[2], sc.sin, sc.cos);
  return Eigen::Map<const Mat3>(columns.data());
}

/// Returns the motion of a joint with a unit axis at q (rad or model length unit), in the child frame at q = 0. It is
/// exactly the identity for q = 0.
inline Pose motion(const Joint& joint, double q) noexcept {
  Pose pose;
  if (joint.kind == JointKind::revolute) {
    pose.rotation = rotation_about(joint.axis, q);
    pose.translation = joint.point - product(pose.rotation, joint.point);
  } else if (joint.kind == JointKind::prismatic) {
    pose.translation = joint.axis * q;
  }
  return pose;
}

}  // namespace hinge
