// SPDX-License-Identifier: BSD-3-Clause
// RelativeTurn: two trees' frames as floats see them, each in the other's, and how far that may be off.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hinge/core/vec3.hpp"
#include "hinge/engine/wide/tree/static_tree.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/simd/lanes.hpp"

namespace hinge {

/// A tree's frame in the world: x_world = R x / scale + middle. R's transpose is kept beside it.
struct TreeFrame {
  TreeFrame() = default;
  /// `local`: the tree's origin in the frame of its group.
  TreeFrame(const Frame& frame, const Vec3& local) noexcept : turn(frame) {
    const simd::Double4 origin = FrameColumns(frame).place(local[0], local[1], local[2]);
    origin.store(middle.data());
    magnitude = largest(max(max(abs(origin), abs(simd::Double4(frame.column.data() + 12))),
                            abs(simd::Double4::of(local[0], local[1], local[2], 0.0))));
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) back.column[4 * r + c] = frame.column[4 * c + r];
  }

  Frame turn, back;
  alignas(32) std::array<double, 4> middle{};
  double magnitude = 0.0;  ///< of what its world coordinates were computed from, model unit
};

/// x -> rotation x + translation in float, from one tree's unit to another's; the rotation holds the ratio of units.
struct Turn {
  alignas(16) std::array<float, 12> rotation;  ///< column by column, each with a spare entry
  alignas(16) std::array<float, 12> size;      ///< its magnitudes, rounded up
  alignas(16) std::array<float, 4> translation;
  float ratio = 1.0F;        ///< of the units
  float box_error = 0.0F;    ///< of turned boxes, in the unit of the result
  float point_error = 0.0F;  ///< of turned points, and twice the rounding of a projection of such a point

  /// The box around the turned box, up to box_error.
  [[gnu::always_inline]] TreeBox operator()(const TreeBox& box) const noexcept {
    using simd::Float4;
    alignas(16) std::array<float, 4> middle, half;
    (Float4(rotation.data()) * Float4(box.middle[0]) + Float4(rotation.data() + 4) * Float4(box.middle[1]) +
     Float4(rotation.data() + 8) * Float4(box.middle[2]) + Float4(translation.data()))
        .store(middle.data());
    (Float4(size.data()) * Float4(box.half[0]) + Float4(size.data() + 4) * Float4(box.half[1]) +
     Float4(size.data() + 8) * Float4(box.half[2]))
        .store(half.data());
    return {{middle[0], middle[1], middle[2]}, {half[0], half[1], half[2]}};
  }
};

/// docs/explanation/float_filter.md derives the errors.
struct RelativeTurn {
  /// extents: largest magnitudes of the trees' coordinates, each in its own unit (scales: per model unit).
  RelativeTurn(const TreeFrame& a, double scale_a, float extent_a, const TreeFrame& b, double scale_b,
               float extent_b) noexcept {
    constexpr double u = 0x1p-24, v = 0x1p-53;
    const double ratio = scale_a / scale_b;  // a power of two
    const simd::Double4 between = simd::Double4(b.middle.data()) - simd::Double4(a.middle.data());
    std::array<double, 4> d, t;
    between.store(d.data());
    const FrameColumns to_a(a.back), to_b(b.back);
    const simd::Double4 shift = to_a.turn(d[0], d[1], d[2]);
    shift.store(t.data());
    (shift * simd::Double4(scale_a)).store_rounded(b_to_a.translation.data());
    (to_b.turn(-d[0], -d[1], -d[2]) * simd::Double4(scale_b)).store_rounded(a_to_b.translation.data());
    const auto set = [](Turn& turn, const FrameColumns& to, const Frame& from, double units) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double* x = from.column.data() + 4 * c;
        const simd::Double4 column = to.turn(x[0], x[1], x[2]) * simd::Double4(units);
        column.store_rounded(turn.rotation.data() + 4 * c);
        (abs(column) * simd::Double4(1 + 16 * u) + simd::Double4(2 * u * units))
            .store_rounded(turn.size.data() + 4 * c);
      }
      turn.ratio = static_cast<float>(units);
    };
    set(b_to_a, to_a, b.turn, ratio);
    set(a_to_b, to_b, a.turn, 1 / ratio);
    const double largest = std::max({std::abs(t[0]), std::abs(t[1]), std::abs(t[2])});
    const double reach =
        2 * (largest * scale_a + static_cast<double>(extent_a) + ratio * static_cast<double>(extent_b));
    const double placing = 64 * v * scale_a * (a.magnitude + b.magnitude);
    const double box_error = 32 * u * reach + 2 * placing, point_error = 20 * u * reach + placing;
    constexpr float up = 1.0F + 0x1p-20F;
    b_to_a.box_error = static_cast<float>(box_error) * up;
    b_to_a.point_error = static_cast<float>(point_error) * up;
    a_to_b.box_error = static_cast<float>(box_error / ratio) * up;
    a_to_b.point_error = static_cast<float>(point_error / ratio) * up;
    sane = reach <= 1e6;
  }

  Turn b_to_a, a_to_b;
  bool sane = false;  ///< within what products of four floats can hold; else nothing is proved apart by points
};

/// Which children of a node may come within `margin` of a box given in the node's frame, `turn` being the turn that
/// brought it there: six face axes. Lanes that are surely farther are left out.
[[gnu::always_inline]] inline simd::Bits near_lanes(const TreeNode& node, const TreeBox& box, const TreeBox& turned,
                                                    const Turn& turn, float margin) noexcept {
  using simd::Float16;
  constexpr std::size_t n = simd::width;
  const float slack = margin + turn.box_error;
  std::array<Float16, 3> d, half;
  std::array<Float16, 6> reach, apart;
  for (std::size_t k = 0; k < 3; ++k) {
    d[k] = Float16(node.middle.data() + k * n) - Float16(turned.middle[k]);
    half[k] = Float16(node.half.data() + k * n);
    reach[k] = half[k] + Float16(turned.half[k] + slack);
    apart[k] = abs(d[k]);
  }
  // The box's own axes are the rotation's columns, as long as the ratio.
  for (std::size_t k = 0; k < 3; ++k) {
    apart[3 + k] = abs(d[0] * Float16(turn.rotation[4 * k]) + d[1] * Float16(turn.rotation[4 * k + 1]) +
                       d[2] * Float16(turn.rotation[4 * k + 2]));
    reach[3 + k] = half[0] * Float16(turn.size[4 * k]) + half[1] * Float16(turn.size[4 * k + 1]) +
                   half[2] * Float16(turn.size[4 * k + 2]) + Float16(turn.ratio * (turn.ratio * box.half[k] + slack));
  }
  const auto far =
      ((less(reach[0], apart[0]) | less(reach[1], apart[1])) | (less(reach[2], apart[2]) | less(reach[3], apart[3]))) |
      (less(reach[4], apart[4]) | less(reach[5], apart[5]));
  return node.used & ~static_cast<simd::Bits>(far);
}

}  // namespace hinge
