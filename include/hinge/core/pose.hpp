// SPDX-License-Identifier: BSD-3-Clause
// Pose: a rigid placement x -> R x + t, composed and applied in a fixed order of operations.
#pragma once

#include <cmath>

#include "hinge/core/finite.hpp"
#include "hinge/core/vec3.hpp"

namespace hinge {

/// A rotation followed by a translation (model length unit). The default is the identity.
struct Pose {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();

  /// The point x, given in the moved frame, in the frame the pose is expressed in.
  friend Vec3 operator*(const Pose& a, const Vec3& x) noexcept { return product(a.rotation, x) + a.translation; }

  /// First b, then a.
  friend Pose operator*(const Pose& a, const Pose& b) noexcept {
    return {product(a.rotation, b.rotation), product(a.rotation, b.translation) + a.translation};
  }

  /// The inverse; exact only as far as the rotation is orthonormal.
  Pose inverse() const noexcept {
    const Mat3 back = rotation.transpose();
    return {back, -product(back, translation)};
  }

  friend bool operator==(const Pose& a, const Pose& b) noexcept {
    return a.rotation == b.rotation && a.translation == b.translation;
  }
};

/// Largest departure of R R^T from the identity that still counts as a rigid placement. A pose within it is used as
/// given; a wider bound would let scaled or sheared placements pass, whose boxes no longer hold what they bound.
inline constexpr double rigid_tolerance = 1e-9;

/// Is every entry finite and the rotation orthonormal (within rigid_tolerance) and right-handed?
inline bool is_rigid(const Pose& x) noexcept {
  for (int r = 0; r < 3; ++r) {
    if (!is_finite(x.translation[r])) return false;
    for (int c = 0; c < 3; ++c)
      if (!is_finite(x.rotation(r, c))) return false;
  }
  const Mat3 gram = product(x.rotation, Mat3(x.rotation.transpose()));
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      if (!(std::abs(gram(r, c) - (r == c ? 1.0 : 0.0)) <= rigid_tolerance)) return false;
  return dot(x.rotation.col(0), cross(x.rotation.col(1), x.rotation.col(2))) > 0.0;
}

}  // namespace hinge
