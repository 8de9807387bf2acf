// SPDX-License-Identifier: BSD-3-Clause
// Three-vectors and 3x3 matrices, with products in a fixed order of operations.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace hinge {

/// A point or direction; coordinates x, y, z.
using Vec3 = Eigen::Vector3d;
/// A 3x3 matrix in column-major order.
using Mat3 = Eigen::Matrix3d;

// Eigen may reorder or contract its own products differently on each instruction set. Coordinates must have the same
// bits everywhere, so every computation of a coordinate or of a collision decision uses these functions.

/// Returns the dot product a . b, summed from x to z.
inline double dot(const Vec3& a, const Vec3& b) noexcept { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Returns the cross product a x b.
inline Vec3 cross(const Vec3& a, const Vec3& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Returns the squared Euclidean length of a.
inline double squared_norm(const Vec3& a) noexcept { return dot(a, a); }

/// Returns the Euclidean length of a.
inline double norm(const Vec3& a) noexcept { return std::sqrt(squared_norm(a)); }

/// Returns the product r v. Each component is summed from x to z.
inline Vec3 product(const Mat3& r, const Vec3& v) noexcept {
  return {r(0, 0) * v[0] + r(0, 1) * v[1] + r(0, 2) * v[2], r(1, 0) * v[0] + r(1, 1) * v[1] + r(1, 2) * v[2],
          r(2, 0) * v[0] + r(2, 1) * v[1] + r(2, 2) * v[2]};
}

/// Returns the product a b, computed column by column.
inline Mat3 product(const Mat3& a, const Mat3& b) noexcept {
  Mat3 c;
  for (int k = 0; k < 3; ++k) c.col(k) = product(a, Vec3(b.col(k)));
  return c;
}

}  // namespace hinge
