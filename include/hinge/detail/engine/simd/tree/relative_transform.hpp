// SPDX-License-Identifier: BSD-3-Clause
// RelativeTransform: the float transforms between the frames of two trees, with error bounds.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/engine/simd/tree/static_tree.hpp"
#include "hinge/detail/kinematics/compose_frames.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/kinematics/frame.hpp"

namespace hinge::detail {

/// A tree's frame in the world: x_world = R x / scale + middle.
struct TreeFrame {
  TreeFrame() = default;
  /// local: the tree's origin in the frame of its group.
  TreeFrame(const Frame& frame, const Vec3& local) noexcept : turn(frame) {
    const simd::Double4 origin = FrameColumns(frame).place(local[0], local[1], local[2]);
    origin.store(middle.data());
    magnitude = largest(max(max(abs(origin), abs(simd::Double4(frame.column.data() + 12))),
                            abs(simd::Double4::of(local[0], local[1], local[2], 0.0))));
  }

  Frame turn;
  alignas(32) std::array<double, 4> middle{};
  double magnitude = 0.0;  ///< largest magnitude of the coordinates it was computed from, model unit
};

/// v -> R^T v for the rotation R of a frame.
class BackTurn {
 public:
  explicit BackTurn(const Frame& frame) noexcept : x_(row(frame, 0)), y_(row(frame, 1)), z_(row(frame, 2)) {}
  simd::Double4 operator()(const double* v) const noexcept {
    return x_ * simd::Double4(v[0]) + y_ * simd::Double4(v[1]) + z_ * simd::Double4(v[2]);
  }

 private:
  static simd::Double4 row(const Frame& frame, std::size_t r) noexcept {
    return simd::Double4::of(frame.column[r], frame.column[4 + r], frame.column[8 + r], 0.0);
  }
  simd::Double4 x_, y_, z_;
};

/// x -> rotation x + translation in float, from one tree's unit to the other's. The rotation includes the ratio of
/// units.
struct Turn {
  alignas(16) std::array<float, 12> rotation;  ///< column by column, each with a spare entry
  alignas(16) std::array<float, 12> size;      ///< absolute values of rotation, rounded up
  alignas(16) std::array<float, 4> translation;
  float ratio = 1.0F;        ///< unit of the result per unit of the argument
  float box_error = 0.0F;    ///< error of transformed boxes, in the unit of the result
  float point_error = 0.0F;  ///< error of transformed points, plus twice the rounding of a projection of such a point

  /// The box around the transformed box; the caller must add box_error.
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

/// Derivation of the errors: docs/explanation/float_filter.md.
struct RelativeTransform {
  /// extents: largest magnitudes of the trees' coordinates, each in its tree's unit; scales: tree units per model unit.
  /// The constructor computes b_to_a only. complete() adds a_to_b: most trees are found apart without it. Refers to b.
  RelativeTransform(const TreeFrame& a, double scale_a, float extent_a, const TreeFrame& b, double scale_b,
                    float extent_b) noexcept
      : frame_b_(b.turn), scale_b_(scale_b) {
    constexpr double u = 0x1p-24, v = 0x1p-53;
    const double ratio = scale_a / scale_b;  // a power of two
    (simd::Double4(a.middle.data()) - simd::Double4(b.middle.data())).store(apart_.data());
    const BackTurn back(a.turn);
    const simd::Double4 shift = -back(apart_.data());
    std::array<double, 4> t;
    shift.store(t.data());
    (shift * simd::Double4(scale_a)).store_rounded(b_to_a.translation.data());
    for (std::size_t c = 0; c < 12; c += 4) {
      const simd::Double4 column = back(b.turn.column.data() + c) * simd::Double4(ratio);
      column.store_rounded(b_to_a.rotation.data() + c);
      (abs(column) * simd::Double4(1 + 16 * u) + simd::Double4(2 * u * ratio)).store_rounded(b_to_a.size.data() + c);
    }
    const double largest = std::max(std::max(std::abs(t[0]), std::abs(t[1])), std::abs(t[2]));
    const double reach =
        2 * (largest * scale_a + static_cast<double>(extent_a) + ratio * static_cast<double>(extent_b));
    const double placing = 64 * v * scale_a * (a.magnitude + b.magnitude);
    const double box_error = 32 * u * reach + 2 * placing, point_error = 20 * u * reach + placing;
    constexpr float up = 1.0F + 0x1p-20F;
    b_to_a.ratio = static_cast<float>(ratio);
    b_to_a.box_error = static_cast<float>(box_error) * up;
    b_to_a.point_error = static_cast<float>(point_error) * up;
    sane = reach <= 1e6;
  }

  /// Computes a_to_b at the first call.
  RelativeTransform& complete() noexcept {
    if (completed_) return *this;
    completed_ = true;
    // Ratios are powers of two: the transpose has the same rounding errors.
    const float back = 1.0F / b_to_a.ratio, square = back * back;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t r = 0; r < 3; ++r) {
        a_to_b.rotation[4 * c + r] = b_to_a.rotation[4 * r + c] * square;
        a_to_b.size[4 * c + r] = b_to_a.size[4 * r + c] * square;
      }
    for (std::size_t k = 3; k < 12; k += 4) a_to_b.rotation[k] = a_to_b.size[k] = 0.0F;
    (BackTurn(frame_b_)(apart_.data()) * simd::Double4(scale_b_)).store_rounded(a_to_b.translation.data());
    a_to_b.ratio = back;
    a_to_b.box_error = b_to_a.box_error * back;
    a_to_b.point_error = b_to_a.point_error * back;
    return *this;
  }

  Turn b_to_a, a_to_b;
  /// false: products of four floats may overflow, and points must not be used to prove anything apart
  bool sane = false;

 private:
  bool completed_ = false;
  const Frame& frame_b_;
  double scale_b_;
  alignas(32) std::array<double, 4> apart_;  // from b's middle to a's middle
};

/// A box of one tree in the frame of another tree, prepared for tests against nodes there.
struct BoxProbe {
  /// turn: transform from the box's tree to the other tree. margin: distance below which boxes are near.
  [[gnu::always_inline]] BoxProbe(const TreeBox& box, const Turn& turn, float margin) noexcept {
    const TreeBox turned = turn(box);
    const float slack = margin + turn.box_error;
    middle = turned.middle;
    for (std::size_t k = 0; k < 3; ++k) {
      reach[k] = turned.half[k] + slack;
      own_reach[k] = turn.ratio * (turn.ratio * box.half[k] + slack);
    }
  }

  std::array<float, 3> middle, reach;
  std::array<float, 3> own_reach;  ///< along the box's own axes
};

/// Children of a node that may be near a box, tested along six face axes. Excluded lanes are surely farther. turn: the
/// transform that the box was made with.
[[gnu::always_inline]] inline simd::Bits near_lanes(const TreeNode& node, const BoxProbe& box,
                                                    const Turn& turn) noexcept {
  using simd::Float16;
  constexpr std::size_t n = simd::width;
  std::array<Float16, 3> d, half;
  std::array<Float16, 6> reach, apart;
  for (std::size_t k = 0; k < 3; ++k) {
    d[k] = Float16(node.middle.data() + k * n) - Float16(box.middle[k]);
    half[k] = Float16(node.half.data() + k * n);
    reach[k] = half[k] + Float16(box.reach[k]);
    apart[k] = abs(d[k]);
  }
  // The box's own axes are the rotation's columns, of length `ratio`.
  for (std::size_t k = 0; k < 3; ++k) {
    apart[3 + k] = abs(d[0] * Float16(turn.rotation[4 * k]) + d[1] * Float16(turn.rotation[4 * k + 1]) +
                       d[2] * Float16(turn.rotation[4 * k + 2]));
    reach[3 + k] = half[0] * Float16(turn.size[4 * k]) + half[1] * Float16(turn.size[4 * k + 1]) +
                   half[2] * Float16(turn.size[4 * k + 2]) + Float16(box.own_reach[k]);
  }
  const auto far =
      ((less(reach[0], apart[0]) | less(reach[1], apart[1])) | (less(reach[2], apart[2]) | less(reach[3], apart[3]))) |
      (less(reach[4], apart[4]) | less(reach[5], apart[5]));
  return node.used & ~static_cast<simd::Bits>(far);
}

}  // namespace hinge::detail
