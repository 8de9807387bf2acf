// SPDX-License-Identifier: BSD-3-Clause
// Converts poses and triangles to the plain arrays of the oracles.
#pragma once

#include <array>
#include <cstddef>

#include "hinge/core/pose.hpp"
#include "hinge/primitive/triangle.hpp"
#include "oracle/fcl_oracle.hpp"

namespace hinge::oracle {

/// Returns rotation by rows, then translation.
inline Placement placement(const Pose& pose) {
  Placement p{};
  for (std::size_t r = 0; r < 3; ++r) {
    const auto row = static_cast<Eigen::Index>(r);
    for (std::size_t c = 0; c < 3; ++c) p[3 * r + c] = pose.rotation(row, static_cast<Eigen::Index>(c));
    p[9 + r] = pose.translation[row];
  }
  return p;
}

/// Returns the coordinates of the corners a, b, c.
inline std::array<double, 9> corners(const Triangle& t) {
  return {t.a[0], t.a[1], t.a[2], t.b[0], t.b[1], t.b[2], t.c[0], t.c[1], t.c[2]};
}

}  // namespace hinge::oracle
