// SPDX-License-Identifier: BSD-3-Clause
// Joints: what connects a link to its parent, and the motion one value of its coordinate makes.
#pragma once

#include <array>
#include <string>
#include <utility>

#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/core/sincos.hpp"

namespace hinge {

/// The child does not move against the parent.
struct Fixed {
  Pose origin{};  ///< child frame in the parent frame
};

/// The child turns by q radians about the line through `point` along `axis`.
struct Revolute {
  Vec3 axis = Vec3::UnitZ();  ///< any length but zero, child frame
  Vec3 point = Vec3::Zero();  ///< any point of the line, child frame
  Pose origin{};              ///< child frame in the parent frame at q = 0
  std::string name{};
};

/// The child slides by q (model length unit) along `axis`.
struct Prismatic {
  Vec3 axis = Vec3::UnitZ();  ///< any length but zero, child frame
  Pose origin{};              ///< child frame in the parent frame at q = 0
  std::string name{};
};

enum class JointKind : unsigned char { fixed, revolute, prismatic };

/// Any of the three: T(child) = T(parent) * origin * motion(q).
struct Joint {
  JointKind kind = JointKind::fixed;
  Pose origin{};
  Vec3 axis = Vec3::UnitZ();  ///< unit length once in a tree
  Vec3 point = Vec3::Zero();
  std::string name{};

  Joint() = default;
  Joint(Fixed j) : origin(std::move(j.origin)) {}
  Joint(Revolute j)
      : kind(JointKind::revolute), origin(j.origin), axis(j.axis), point(j.point), name(std::move(j.name)) {}
  Joint(Prismatic j) : kind(JointKind::prismatic), origin(j.origin), axis(j.axis), name(std::move(j.name)) {}

  bool has_dof() const noexcept { return kind != JointKind::fixed; }
};

/// The rotation about the unit axis (x, y, z) by the angle of this sine and cosine (Rodrigues), column by column, in a
/// fixed order of operations. T: double, or lanes of it.
template <class T>
[[gnu::always_inline]] inline std::array<T, 9> rotation_columns(const T& x, const T& y, const T& z, const T& sine,
                                                                const T& cosine) noexcept {
  const T v = T(1.0) - cosine;
  const T xs = x * sine, ys = y * sine, zs = z * sine;
  return {cosine + x * x * v, x * y * v + zs,     x * z * v - ys,  //
          x * y * v - zs,     cosine + y * y * v, y * z * v + xs,  //
          x * z * v + ys,     y * z * v - xs,     cosine + z * z * v};
}

/// The rotation by `angle` (rad) about a unit axis; exactly the identity at 0.
inline Mat3 rotation_about(const Vec3& axis, double angle) noexcept {
  const detail::SinCos sc = detail::sincos(angle);
  const auto columns = rotation_columns(axis[0], axis[1], axis[2], sc.sin, sc.cos);
  return Eigen::Map<const Mat3>(columns.data());
}

/// The motion a joint with a unit axis makes at q (rad or model length unit). Exactly the identity at q = 0.
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
