// SPDX-License-Identifier: BSD-3-Clause
// FloatTransform: a rigid group's frame applied to points and boxes in the floats of engine/simd.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/rigid_blocks.hpp"
#include "hinge/detail/kinematics/compose_frames.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/kinematics/frame.hpp"

namespace hinge::detail {

/// Above this, squares may overflow in float. Such a box is replaced by an infinite one, and its contents are decided
/// in double.
inline constexpr float largest_sane_coordinate = 1e15F;

/// The box, or an infinite box if a coordinate is too large or NaN.
[[gnu::always_inline]] inline FloatBox sane(const FloatBox& box) noexcept {
  if (!(box.extent() <= largest_sane_coordinate)) [[unlikely]]
    return FloatBox::everything();
  return box;
}

/// The same for a box and the coordinates in it. Large coordinates are clamped, which never increases a distance.
/// Infinite coordinates would become NaN when inflated by an infinite length, and look apart.
[[gnu::always_inline]] inline FloatBox sane(const FloatBox& box, std::span<float> coordinates) noexcept {
  const FloatBox kept = sane(box);
  if (kept.extent() > largest_sane_coordinate) [[unlikely]]
    for (float& x : coordinates) x = std::clamp(x, -largest_sane_coordinate, largest_sane_coordinate);
  return kept;
}

/// x -> (R x + t - origin) * scale. Middles are computed in double and rounded once; offsets from them are float.
class FloatTransform {
 public:
  FloatTransform(const Frame& frame, const Vec3& origin, double scale) noexcept
      : frame_(frame), origin_(origin), scale_(scale) {
    for (std::size_t k = 0; k < 9; ++k) rotation_[k] = static_cast<float>(frame.column[k / 3 * 4 + k % 3]);
  }

  /// Column by column.
  const std::array<float, 9>& rotation() const noexcept { return rotation_; }

  std::array<float, 3> operator()(const std::array<double, 3>& point) const noexcept {
    std::array<float, 4> x;
    ((FrameColumns(frame_).place(point[0], point[1], point[2]) -
      simd::Double4::of(origin_[0], origin_[1], origin_[2], 0.0)) *
     simd::Double4(scale_))
        .store_rounded(x.data());
    return {x[0], x[1], x[2]};
  }

  /// The box around the rotated box. Its half lengths include the rounding of rotation, products and sums.
  FloatBox operator()(const LocalBox& local) const noexcept {
    const std::array<float, 3> middle = (*this)(local.middle);
    const std::array<float, 9>& r = rotation_;
    FloatBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      const float half =
          (std::abs(r[k]) * local.half[0] + std::abs(r[3 + k]) * local.half[1] + std::abs(r[6 + k]) * local.half[2]) *
          half_rounding;
      box.lower[k] = middle[k] - half;
      box.upper[k] = middle[k] + half;
    }
    return sane(box);
  }

  /// Boxes around the boxes of lanes first .. last - 1 of a row, inflated by reach, and their largest coordinate
  /// magnitudes. `whole`: the box whose middle is the origin of the row's middles.
  void turn_row(const LocalRow& local, const LocalBox& whole, float reach, std::size_t first, std::size_t last,
                BoxRow& boxes, float* extents) const noexcept {
    using simd::Float16;
    constexpr std::size_t n = simd::width;
    const std::array<float, 3> middle = (*this)(whole.middle);
    Float16 extent(0.0F);
    for (std::size_t k = 0; k < 3; ++k) {
      Float16 m(middle[k]), h(0.0F);
      for (std::size_t j = 0; j < 3; ++j) {
        m = m + Float16(rotation_[3 * j + k]) * Float16(local.middle.data() + j * n);
        h = h + Float16(std::abs(rotation_[3 * j + k])) * Float16(local.half.data() + j * n);
      }
      h = h * Float16(half_rounding) + Float16(reach);
      (m - h).store_lanes(first, last, boxes.lower.data() + k * n);
      (m + h).store_lanes(first, last, boxes.upper.data() + k * n);
      extent = max(extent, abs(m) + h);
    }
    extent.store_lanes(first, last, extents);
    const simd::Bits sane_lanes = less_equal(extent, Float16(largest_sane_coordinate));
    for (std::size_t k = first; sane_lanes != simd::all_bits && k < last; ++k)
      if ((sane_lanes >> k & 1U) == 0) {
        boxes.set(k, FloatBox::everything());
        extents[k] = std::numeric_limits<float>::infinity();
      }
  }

 private:
  static constexpr float half_rounding = 1.0F + 8 * 0x1p-24F;

  const Frame& frame_;
  const Vec3& origin_;
  double scale_;
  std::array<float, 9> rotation_;
};

}  // namespace hinge::detail
