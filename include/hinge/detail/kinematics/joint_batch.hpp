// SPDX-License-Identifier: BSD-3-Clause
// JointBatch: the constants of eight joints in SIMD layout, and their motions computed together.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "hinge/detail/simd/sincos.hpp"
#include "hinge/kinematics/joint.hpp"

namespace hinge::detail {

/// Joints of eight consecutive rigid groups. Results in unused slots are never read.
struct alignas(64) JointBatch {
  static constexpr std::size_t size = 8;
  std::array<double, 3 * size> axis{};   // x of all joints, then y, then z
  std::array<double, 3 * size> point{};  // same layout
  std::array<std::uint32_t, size> dof{};
  std::uint8_t sliding = 0;     // bit k: joint k is prismatic
  std::uint8_t has_origin = 0;  // bit k: joint k has an origin other than the identity

  void set(std::size_t k, const Joint& joint, std::size_t position) noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
      axis[i * size + k] = joint.axis[static_cast<Eigen::Index>(i)];
      point[i * size + k] = joint.point[static_cast<Eigen::Index>(i)];
    }
    dof[k] = static_cast<std::uint32_t>(position);
    const auto bit = static_cast<std::uint8_t>(1U << k);
    if (joint.kind == JointKind::prismatic) sliding |= bit;
    if (!(joint.origin == Pose{})) has_origin |= bit;
  }
};

/// Entry e (rotation column by column, then translation) of joint k is at [e * JointBatch::size + k].
using JointMotions = std::array<double, 12 * JointBatch::size>;

/// Computes motion(joint, q) for the eight joints, with the same bits.
inline void compute_motions(const JointBatch& batch, const double* q, JointMotions& motions) noexcept {
  constexpr std::size_t n = JointBatch::size;
  std::array<double, n> angle;
  double largest = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    angle[k] = q[batch.dof[k]];
    largest = std::max(largest, std::abs(angle[k]));
  }
  simd::Double8 s, c;
  simd::sincos(angle.data(), largest <= cody_waite_limit, s, c);
  const simd::Double8 x(batch.axis.data()), y(batch.axis.data() + n), z(batch.axis.data() + 2 * n);
  const simd::Double8 px(batch.point.data()), py(batch.point.data() + n), pz(batch.point.data() + 2 * n);
  const auto r = rotation_columns(x, y, z, s, c);
  // With constant indices r stays in registers.
  [&]<std::size_t... e>(std::index_sequence<e...>) { (r[e].store(motions.data() + e * n), ...); }
  (std::make_index_sequence<9>{});
  (px - (r[0] * px + r[3] * py + r[6] * pz)).store(motions.data() + 9 * n);
  (py - (r[1] * px + r[4] * py + r[7] * pz)).store(motions.data() + 10 * n);
  (pz - (r[2] * px + r[5] * py + r[8] * pz)).store(motions.data() + 11 * n);
  for (std::size_t k = 0; batch.sliding >> k != 0; ++k) {
    if ((batch.sliding >> k & 1U) == 0) continue;
    for (std::size_t e = 0; e < 9; ++e) motions[e * n + k] = e % 4 == 0 ? 1.0 : 0.0;
    for (std::size_t e = 0; e < 3; ++e) motions[(9 + e) * n + k] = batch.axis[e * n + k] * angle[k];
  }
}

}  // namespace hinge::detail
