// SPDX-License-Identifier: BSD-3-Clause
// Applies frames to points and composes frames, four doubles at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "hinge/core/pose.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/kinematics/frame.hpp"

namespace hinge::detail {

/// The columns of a frame in registers. turn: R v. place: R v + t.
class FrameColumns {
 public:
  [[gnu::always_inline]] explicit FrameColumns(const Frame& frame) noexcept
      : x_(frame.column.data()),
        y_(frame.column.data() + 4),
        z_(frame.column.data() + 8),
        t_(frame.column.data() + 12) {}
  [[gnu::always_inline]] simd::Double4 turn(double x, double y, double z) const noexcept {
    return x_ * simd::Double4(x) + y_ * simd::Double4(y) + z_ * simd::Double4(z);
  }
  [[gnu::always_inline]] simd::Double4 place(double x, double y, double z) const noexcept { return turn(x, y, z) + t_; }

 private:
  simd::Double4 x_, y_, z_, t_;
};

/// Computes a * motion. The twelve entries of motion (rotation column by column, then translation) are `stride` doubles
/// apart.
[[gnu::always_inline]] inline void compose(const Frame& a, const double* motion, std::size_t stride,
                                           Frame& result) noexcept {
  const FrameColumns columns(a);
  const auto entry = [&](std::size_t k) { return motion[k * stride]; };
  for (std::size_t k = 0; k < 3; ++k)
    columns.turn(entry(3 * k), entry(3 * k + 1), entry(3 * k + 2)).store(result.column.data() + 4 * k);
  columns.place(entry(9), entry(10), entry(11)).store(result.column.data() + 12);
}

inline void compose(const Frame& a, const Pose& b, Frame& result) noexcept {
  std::array<double, 12> motion;
  std::copy_n(b.rotation.data(), 9, motion.data());
  std::copy_n(b.translation.data(), 3, motion.data() + 9);
  compose(a, motion.data(), 1, result);
}

}  // namespace hinge::detail
