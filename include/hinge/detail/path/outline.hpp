// SPDX-License-Identifier: BSD-3-Clause
// Outline: points around a rigid group, in lanes of sixteen. Their largest speed bounds the speed of the whole group.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// The speed of x is |v + w x (x - c)|. It is less than |v| + |w| |x - c| if the two terms partly cancel, as they do in
/// half of the directions far from the axis. The speed is convex in x, so the corners of a box bound it for many
/// points. Groups with few points have no outline: the gain is not worth the time.
class Outline {
 public:
  Outline() = default;

  /// Covers the convex hull of `points`, inflated by `size`. extent: largest distance of this set from `centre`. All
  /// lengths in one unit.
  Outline(std::span<const Vec3> points, const Vec3& centre, double size, double extent) : extent_(extent), size_(size) {
    if (points.size() < fewest || !(extent > 0.0)) return;
    std::vector<Vec3> around(points.begin(), points.end());
    if (points.size() > most) {
      Aabb box;
      for (const Vec3& x : points) box.extend(Aabb(x));
      around.clear();
      for (unsigned corner = 0; corner < 8; ++corner)
        around.emplace_back((corner & 1U) != 0 ? box.upper[0] : box.lower[0],
                            (corner & 2U) != 0 ? box.upper[1] : box.lower[1],
                            (corner & 4U) != 0 ? box.upper[2] : box.lower[2]);
    }
    // The last block is padded with a repeated point.
    const std::size_t blocks = (around.size() + simd::width - 1) / simd::width;
    at_.resize(blocks * 3 * simd::width);
    for (std::size_t k = 0; k < blocks * simd::width; ++k) {
      const Vec3& x = around[std::min(k, around.size() - 1)];
      for (std::size_t axis = 0; axis < 3; ++axis)
        at_[(k / simd::width * 3 + axis) * simd::width + k % simd::width] =
            static_cast<float>((x[static_cast<Eigen::Index>(axis)] - centre[static_cast<Eigen::Index>(axis)]) / extent);
    }
  }

  bool is_empty() const noexcept { return at_.empty(); }

  /// Bound of the speed. velocity: of the centre; turn: angular velocity; both in the group's axes. loose: |velocity| +
  /// |turn| extent, finite and above 0.
  double largest_speed(const Vec3& velocity, const Vec3& turn, double loose) const noexcept {
    // Divide by the loose bound, so that no float overflows.
    using simd::Float16;
    const auto share = [&](double x) { return Float16(static_cast<float>(x / loose)); };
    const Float16 v0 = share(velocity[0]), v1 = share(velocity[1]), v2 = share(velocity[2]);
    const Float16 w0 = share(turn[0] * extent_), w1 = share(turn[1] * extent_), w2 = share(turn[2] * extent_);
    Float16 squared(0.0F);
    for (const float* x = at_.data(); x != at_.data() + at_.size(); x += 3 * simd::width) {
      const Float16 x0(x), x1(x + simd::width), x2(x + 2 * simd::width);
      const Float16 s0 = v0 + (w1 * x2 - w2 * x1), s1 = v1 + (w2 * x0 - w0 * x2), s2 = v2 + (w0 * x1 - w1 * x0);
      squared = max(squared, s0 * s0 + s1 * s1 + s2 * s2);
    }
    const double tight = std::sqrt(static_cast<double>(largest(squared))) * (1.0 + rounding) + rounding;
    return std::min(loose, loose * tight + norm(turn) * size_);
  }

 private:
  static constexpr std::size_t fewest = 12;
  static constexpr std::size_t most = 256;  // with more points, the corners of their box are used
  // All numbers are below 4, corners included. Speeds are off by at most 32 half ulps of a float, 2^-19.
  static constexpr double rounding = 0x1p-18;

  double extent_ = 0.0, size_ = 0.0;
  simd::AlignedVector<float> at_;  // per block x, y, z of sixteen points, relative to the centre, divided by the extent
};

}  // namespace hinge::detail
