// SPDX-License-Identifier: BSD-3-Clause
// Frame: a pose laid out for SIMD: four columns of four doubles, the last row unused.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "hinge/core/pose.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge {

/// Columns x, y, z of the rotation, then the translation; entry 3 of each is zero. Composed in the order of operations
/// of Pose, so with its bits.
struct alignas(32) Frame {
  std::array<double, 16> column{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0};

  Frame() = default;
  /// (Written as wide as it is read: narrower writes would have to reach the cache before they can be read.)
  explicit Frame(const Pose& pose) noexcept {
    const auto put = [this](std::size_t k, const double* from) {
      detail::simd::Double4::of(from[0], from[1], from[2], 0.0).store(column.data() + 4 * k);
    };
    for (std::size_t k = 0; k < 3; ++k) put(k, pose.rotation.data() + 3 * k);
    put(3, pose.translation.data());
  }
  /// The same numbers? (Without branches: it is asked about many, most of which differ.)
  bool is(const Pose& pose) const noexcept {
    bool same = true;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t r = 0; r < 3; ++r) same &= column[4 * k + r] == pose.rotation.data()[3 * k + r];
    for (std::size_t r = 0; r < 3; ++r) same &= column[12 + r] == pose.translation.data()[r];
    return same;
  }
  Pose pose() const noexcept {
    Pose pose;
    for (std::size_t k = 0; k < 3; ++k) std::copy_n(column.data() + 4 * k, 3, pose.rotation.data() + 3 * k);
    std::copy_n(column.data() + 12, 3, pose.translation.data());
    return pose;
  }
};

}  // namespace hinge
