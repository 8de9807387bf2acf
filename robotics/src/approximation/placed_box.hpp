// SPDX-License-Identifier: BSD-3-Clause
// placed_box: bounds of the contents of a box after a rigid motion.
#pragma once

#include <algorithm>
#include <cmath>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/pose.hpp"

namespace hinge::robotics {

/// Returns a box around the placed contents of `local`, rounded outward. `local` must not be empty.
inline Aabb placed_box(const Aabb& local, const Pose& pose) noexcept {
  // A placed coordinate is a sum of three products and a shift, with an error of at most 6 half ulps of their
  // magnitudes. The numbers below have the same error. 32 half ulps cover both.
  constexpr double slack = 0x1p-48;
  Vec3 middle, half;
  double size = 0.0;
  for (int k = 0; k < 3; ++k) {
    middle[k] = local.middle(k);
    half[k] = std::max(local.upper[k] - middle[k], middle[k] - local.lower[k]);
    size += std::max(std::abs(local.lower[k]), std::abs(local.upper[k])) + std::abs(pose.translation[k]);
  }
  const Vec3 center = pose * middle, reach = product(Mat3(pose.rotation.cwiseAbs()), half);
  const Vec3 grown = reach + Vec3::Constant(slack * size);
  return {center - grown, center + grown};
}

}  // namespace hinge::robotics
