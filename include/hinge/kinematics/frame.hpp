// SPDX-License-Identifier: BSD-3-Clause
// Frame: a pose in SIMD layout, with four columns of four doubles. The last row is unused.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "hinge/core/pose.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge {

/// Columns x, y, z of the rotation, then the translation (model length unit). Entry 3 of each column is 0 in frames
/// made from poses. Compositions of frames use the order of operations of Pose and give the same bits.
struct alignas(32) Frame {
  /// Column k is column[4 k] ... column[4 k + 3].
  std::array<double, 16> column{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0};

  /// The identity.
  Frame() = default;
  /// Stores whole columns. Narrower stores would stall the later wide loads, since they cannot be forwarded to them.
  explicit Frame(const Pose& pose) noexcept {
    const auto put = [this](std::size_t k, const double* from) {
      detail::simd::Double4::of(from[0], from[1], from[2], 0.0).store(column.data() + 4 * k);
    };
    for (std::size_t k = 0; k < 3; ++k) put(k, pose.rotation.data() + 3 * k);
    put(3, pose.translation.data());
  }
  /// Returns true when all entries are equal to the pose's. Branch-free: most calls of a sequence return false.
  bool is(const Pose& pose) const noexcept {
    bool same = true;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t r = 0; r < 3; ++r) same &= column[4 * k + r] == pose.rotation.data()[3 * k + r];
    for (std::size_t r = 0; r < 3; ++r) same &= column[12 + r] == pose.translation.data()[r];
    return same;
  }
  /// Returns the same transform as a Pose.
  Pose pose() const noexcept {
    Pose pose;
    for (std::size_t k = 0; k < 3; ++k) std::copy_n(column.data() + 4 * k, 3, pose.rotation.data() + 3 * k);
    std::copy_n(column.data() + 12, 3, pose.translation.data());
    return pose;
  }
};

}  // namespace hinge
