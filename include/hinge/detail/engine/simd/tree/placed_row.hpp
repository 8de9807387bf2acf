// SPDX-License-Identifier: BSD-3-Clause
// PlacedRow: boxes and balls of sixteen tree parts in the world, in float, and the test of one of them against a row.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/float_transform.hpp"
#include "hinge/detail/engine/simd/tree/tree_parts.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// Lengths in tree units, relative to the world origin of PlacedTrees.
struct alignas(64) PlacedRow {
  /// Three columns of the rotation, then the tree's origin in the world; each column has a spare entry.
  struct alignas(64) FloatFrame : std::array<float, 16> {};

  BoxRow box;  ///< reaches included
  std::array<float, 3 * simd::width> middle{};
  std::array<float, simd::width> radius{};      ///< radius of the ball, plus twice the error of a coordinate
  std::array<float, 12 * simd::width> frame{};  ///< frames of the lanes, entry by entry

  [[gnu::always_inline]] void set_frame(std::size_t lane, const FloatFrame& from) noexcept {
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t k = 0; k < 3; ++k) frame[(3 * c + k) * simd::width + lane] = from[4 * c + k];
  }

  /// Computes boxes and balls from the frames. Lanes without a tree part get arbitrary values.
  void place(const PartRow& local) noexcept {
    using simd::Float16;
    constexpr std::size_t n = simd::width;
    // Relative error of the rotation's rounding, its products and sums.
    constexpr float rounding = 32 * 0x1p-24F;
    const auto entry = [&](std::size_t k) { return Float16(frame.data() + k * n); };
    std::array<Float16, 3> at, half;
    Float16 size(0.0F);
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = entry(9 + k);
      half[k] = Float16(0.0F);
      for (std::size_t j = 0; j < 3; ++j) {
        at[k] = at[k] + entry(3 * j + k) * Float16(local.middle.data() + j * n);
        half[k] = half[k] + abs(entry(3 * j + k)) * Float16(local.half.data() + j * n);
      }
      size = max(size,
                 abs(at[k]) + half[k] + abs(Float16(local.middle.data() + k * n)) + Float16(local.half.data() + k * n));
    }
    const Float16 error = size * Float16(rounding);
    (Float16(local.radius.data()) + error * Float16(2.0F)).store(radius.data());
    for (std::size_t k = 0; k < 3; ++k) {
      (at[k] - half[k] - error).store(box.lower.data() + k * n);
      (at[k] + half[k] + error).store(box.upper.data() + k * n);
      at[k].store(middle.data() + k * n);
    }
    const simd::Bits sane_lanes = less_equal(size, Float16(largest_sane_coordinate));
    for (std::size_t lane = 0; sane_lanes != simd::all_bits && lane < n; ++lane)
      if ((sane_lanes >> lane & 1U) == 0) box.set(lane, FloatBox::everything());
  }

  /// One tree part of a row, inflated by a margin, prepared for tests against rows. Branch-free: the outcome is
  /// unpredictable.
  class Probe {
   public:
    [[gnu::always_inline]] Probe(const PlacedRow& row, std::size_t lane, float margin) noexcept {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = k * simd::width + lane;
        lower_[k] = simd::Float16(row.box.lower[at] - margin);
        upper_[k] = simd::Float16(row.box.upper[at] + margin);
        middle_[k] = simd::Float16(row.middle[at]);
      }
      radius_ = simd::Float16(row.radius[lane] + std::max(margin, 0.0F));
    }
    /// Lanes whose boxes overlap and whose balls are not surely apart.
    [[gnu::always_inline]] simd::Bits near(const PlacedRow& row) const noexcept {
      using simd::Float16;
      constexpr std::size_t n = simd::width;
      std::array<Float16, 3> d;
      for (std::size_t k = 0; k < 3; ++k) d[k] = Float16(row.middle.data() + k * n) - middle_[k];
      // Covers the rounding of the sums.
      const Float16 reach = (Float16(row.radius.data()) + radius_) * Float16(1.0F + 0x1p-20F);
      const auto apart = less(reach * reach, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      const auto meets = [&](std::size_t k) __attribute__((always_inline)) {
        return less_equal(Float16(row.box.lower.data() + k * n), upper_[k]) &
               less_equal(lower_[k], Float16(row.box.upper.data() + k * n));
      };
      return static_cast<simd::Bits>(meets(0) & meets(1) & meets(2)) & ~static_cast<simd::Bits>(apart);
    }

   private:
    std::array<simd::Float16, 3> lower_, upper_, middle_;
    simd::Float16 radius_;
  };
};

}  // namespace hinge::detail
