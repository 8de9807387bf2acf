// SPDX-License-Identifier: BSD-3-Clause
// Pose: a rigid transform x -> R x + t, composed and applied in a fixed order of operations.
#pragma once

#include <cmath>

#include "hinge/core/finite.hpp"
#include "hinge/core/vec3.hpp"

namespace hinge {

/// A rotation followed by a translation (model length unit). The default is the identity. The pose of frame B in frame
/// A maps coordinates in B to coordinates in A.
struct Pose {
  Mat3 rotation = Mat3::Identity();  ///< orthonormal and right-handed
  Vec3 translation = Vec3::Zero();   ///< model length unit

  /// Maps point x from the inner frame to the outer frame: R x + t.
  friend Vec3 operator*(const Pose& a, const Vec3& x) noexcept { return product(a.rotation, x) + a.translation; }

  /// Composition: applies b first, then a.
  friend Pose operator*(const Pose& a, const Pose& b) noexcept {
    return {product(a.rotation, b.rotation), product(a.rotation, b.translation) + a.translation};
  }

  /// Returns the inverse transform. It uses R^T, so it is exact only as far as the rotation is orthonormal.
  Pose inverse() const noexcept {
    const Mat3 back = rotation.transpose();
    return {back, -product(back, translation)};
  }

  /// Returns true when every entry is equal. There is no tolerance.
  friend bool operator==(const Pose& a, const Pose& b) noexcept {
    return a.rotation == b.rotation && a.translation == b.translation;
  }
};

/// Largest deviation of an entry of R^T R from the identity in an accepted pose. Accepted poses are used unchanged. A
/// larger tolerance would accept scaled or sheared transforms, and boxes would no longer contain their contents.
inline constexpr double rigid_tolerance = 1e-9;

/// Returns true when every translation component is a length (is_length), and the rotation is finite, orthonormal
/// within rigid_tolerance, and right-handed.
inline bool is_rigid(const Pose& x) noexcept {
  const Vec3 a = x.rotation.col(0), b = x.rotation.col(1), c = x.rotation.col(2);
  const auto is_near = [](double value, double wanted) { return std::abs(value - wanted) <= rigid_tolerance; };
  return is_length(x.translation) && is_finite(a) && is_finite(b) && is_finite(c) && is_near(dot(a, a), 1.0) &&
         is_near(dot(b, b), 1.0) && is_near(dot(c, c), 1.0) && is_near(dot(a, b), 0.0) && is_near(dot(a, c), 0.0) &&
         is_near(dot(b, c), 0.0) && dot(a, cross(b, c)) > 0.0;
}

}  // namespace hinge
