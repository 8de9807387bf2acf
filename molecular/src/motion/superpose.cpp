// SPDX-License-Identifier: BSD-3-Clause
// Computes superpositions by Horn's method.
#include "motion/superpose.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace hinge::molecular {

namespace {

using Quaternion = std::array<double, 4>;

/// Returns the eigenvector of the largest eigenvalue of a symmetric matrix, by Jacobi's rotations (Golub & Van Loan,
/// Matrix Computations, section 8.5). Only scalars, in a fixed order: the bits are the same for every instruction set.
Quaternion largest_eigenvector(std::array<Quaternion, 4> n) {
  std::array<Quaternion, 4> vectors{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};  // in columns
  constexpr int most_sweeps = 30;  // five are usual: convergence is quadratic
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double off = 0.0, scale = 0.0;
    for (std::size_t p = 0; p < 4; ++p)
      for (std::size_t q = 0; q < 4; ++q) (p == q ? scale : off) += std::abs(n[p][q]);
    if (!(off > 0x1p-60 * scale)) break;
    for (std::size_t p = 0; p < 3; ++p)
      for (std::size_t q = p + 1; q < 4; ++q) {
        if (n[p][q] == 0.0) continue;
        const double tau = (n[q][q] - n[p][p]) / (2.0 * n[p][q]);
        const double t = std::copysign(1.0, tau) / (std::abs(tau) + std::sqrt(1.0 + tau * tau));
        const double c = 1.0 / std::sqrt(1.0 + t * t), s = t * c;
        const auto rotate = [&](double& a, double& b) {
          const double old = a;
          a = c * old - s * b;
          b = s * old + c * b;
        };
        for (std::size_t k = 0; k < 4; ++k) rotate(n[k][p], n[k][q]);
        for (std::size_t k = 0; k < 4; ++k) rotate(n[p][k], n[q][k]);
        for (Quaternion& row : vectors) rotate(row[p], row[q]);
        n[p][q] = n[q][p] = 0.0;
      }
  }
  std::size_t largest = 0;
  for (std::size_t k = 1; k < 4; ++k)
    if (n[k][k] > n[largest][largest]) largest = k;
  return {vectors[0][largest], vectors[1][largest], vectors[2][largest], vectors[3][largest]};
}

}  // namespace

Vec3 centre(std::span<const Vec3> positions) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& position : positions) sum += position;
  return sum / static_cast<double>(positions.size());
}

Mat3 closest_rotation(std::span<const Vec3> moved, const Vec3& centre_moved, std::span<const Vec3> onto,
                      const Vec3& centre_onto) {
  double m[3][3] = {};
  for (std::size_t i = 0; i < moved.size(); ++i)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) m[r][c] += (moved[i][r] - centre_moved[r]) * (onto[i][c] - centre_onto[c]);
  auto [w, x, y, z] =
      largest_eigenvector({{{m[0][0] + m[1][1] + m[2][2], m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]},
                            {m[1][2] - m[2][1], m[0][0] - m[1][1] - m[2][2], m[0][1] + m[1][0], m[2][0] + m[0][2]},
                            {m[2][0] - m[0][2], m[0][1] + m[1][0], m[1][1] - m[0][0] - m[2][2], m[1][2] + m[2][1]},
                            {m[0][1] - m[1][0], m[2][0] + m[0][2], m[1][2] + m[2][1], m[2][2] - m[0][0] - m[1][1]}}});
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  w /= length, x /= length, y /= length, z /= length;
  Mat3 rotation;
  rotation << 1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y),  //
      2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x),          //
      2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y);
  return rotation;
}

}  // namespace hinge::molecular
