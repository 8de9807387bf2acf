// SPDX-License-Identifier: BSD-3-Clause
// DisplacementBounds: bounds of the displacement of each group from a reference, over the configurations in the lanes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/batch/frame_lanes.hpp"
#include "hinge/detail/batch/lane_kinematics.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Change of a group's frame since the reference: differences computed in double, stored in float.
class LaneStep {
 public:
  [[gnu::always_inline]] void set(const double* frames, const Pose& reference) noexcept {
    for (std::size_t e = 0; e < FrameLanes::entries; ++e) {
      const simd::Double8 from(e < 9 ? reference.rotation.data()[e] : reference.translation.data()[e - 9]);
      const std::size_t k = e * simd::width;
      simd::Float16::rounded(simd::Double8(frames + k) - from, simd::Double8(frames + k + 8) - from)
          .store(entry_.data() + k);
    }
  }
  [[gnu::always_inline]] simd::Float16 entry(std::size_t e) const noexcept {
    return simd::Float16(entry_.data() + e * simd::width);
  }
  /// Displacement of a point (in the group's frame), per lane.
  [[gnu::always_inline]] LaneVector travel(const Vec3& point) const noexcept {
    using simd::Float16;
    const Float16 x(static_cast<float>(point[0])), y(static_cast<float>(point[1])), z(static_cast<float>(point[2]));
    const auto axis = [&](std::size_t k) __attribute__((always_inline)) {
      return entry(k) * x + entry(3 + k) * y + entry(6 + k) * z + entry(9 + k);
    };
    return {axis(0), axis(1), axis(2)};
  }

 private:
  alignas(64) std::array<float, FrameLanes::entries * simd::width> entry_{};
};

/// Differences of frames are computed in double and stored in float: their error is relative to the displacement, not
/// to the length of the chain. Derivation: docs/explanation/state_batch.md.
class DisplacementBounds {
 public:
  /// Computes a ball around each group's primitives, in the group's frame.
  template <Primitive P>
  explicit DisplacementBounds(const SelectedModel<P>& model)
      : balls_(model.groups()->size()),
        reference_(model.groups()->size()),
        ways_(model.groups()->size(), 0.0),
        errors_(model.groups()->size(), 0.0) {
    for (std::size_t g = 0; g < balls_.size(); ++g) {
      Aabb box;
      for (const PrimitiveId i : model.primitives_of(id<GroupId>(g))) box.extend(model.primitives()[index(i)].bounds());
      if (box.is_empty()) continue;
      Ball& ball = balls_[g];
      for (int k = 0; k < 3; ++k) ball.centre[k] = box.middle(k);
      double square = 0.0;
      for (const double* x : {box.lower.data(), box.upper.data()}) {
        Vec3 d = Vec3(x[0], x[1], x[2]) - ball.centre;
        square = std::max(square, squared_norm(d));
      }
      // The farthest corner: boxes are centred only up to rounding.
      ball.radius = std::sqrt(square) * (1.0 + 0x1p-40);
      ball.reach = std::sqrt(squared_norm(ball.centre)) * (1.0 + 0x1p-40) + ball.radius;
      ball.empty = false;
    }
  }

  /// Makes the present configuration in `lane` the reference.
  void set_reference(const FrameLanes& frames, std::size_t lane) noexcept {
    for (std::size_t g = 0; g < reference_.size(); ++g) reference_[g] = frames.pose(id<GroupId>(g), lane);
  }
  const Pose& reference(GroupId group) const noexcept { return reference_[index(group)]; }

  /// Starts measuring. The bounds will hold for lanes first .. end - 1.
  void begin(std::size_t first, std::size_t end) noexcept {
    first_ = first;
    end_ = end;
    farthest_.fill(0.0);
  }
  /// Compares all lanes of a group to the reference.
  void measure(const FrameLanes& frames, GroupId group) noexcept {
    if (balls_[index(group)].empty) return;
    const double* const translations = frames[group] + 9 * width;
    simd::Double8 farthest(farthest_.data());
    for (std::size_t k = 0; k < 3 * width; k += 8) farthest = max(farthest, abs(simd::Double8(translations + k)));
    farthest.store(farthest_.data());
    // Process several groups together: loading a vector right after its halves were stored is slow.
    steps_[waiting_].set(frames[group], reference_[index(group)]);
    step_of_[waiting_++] = group;
    if (waiting_ == steps_.size()) judge();
  }
  void measure(const FrameLanes& frames, std::size_t first, std::size_t end) noexcept {
    begin(first, end);
    for (std::size_t g = 1; g < balls_.size(); ++g) measure(frames, id<GroupId>(g));
    finish();
  }
  /// Call this after all groups are measured.
  void finish() noexcept {
    judge();
    // above sqrt(3): the norm of three components
    farthest_of_all_ = 2 * *std::max_element(farthest_.begin(), farthest_.end());
  }

  /// Bound of the distance of any point of the group's primitives from its position at the reference, both placed as by
  /// single queries; model length unit. Infinite if floats cannot tell.
  double bound(GroupId group) const noexcept { return ways_[index(group)] * (1.0 + 16 * u) + error(group); }
  /// Bound of the error of a displacement of a point of the group's primitives, placing in double included.
  double error(GroupId group) const noexcept {
    const Ball& ball = balls_[index(group)];
    if (ball.empty) return 0.0;
    const double size = ball.reach + farthest_of_all_;
    constexpr double placing = 64 * 0x1p-53;  // both placements round
    return size <= largest_safe ? errors_[index(group)] + placing * size : std::numeric_limits<double>::infinity();
  }

 private:
  static constexpr std::size_t width = simd::width;
  static constexpr double u = 0x1p-24;  // relative error of one rounding to float
  /// Loss of float squares by underflow, as a length.
  static constexpr double lost = 0x1p-70;
  /// Squares of such lengths are far below the largest float.
  static constexpr double largest_safe = 1e18;

  struct Ball {
    Vec3 centre = Vec3::Zero();
    double radius = 0.0;
    double reach = 0.0;  // from the frame's origin
    bool empty = true;
  };
  void judge() noexcept {
    using simd::Float16;
    for (std::size_t k = 0; k < waiting_; ++k) {
      const std::size_t g = index(step_of_[k]);
      const Ball& ball = balls_[g];
      const LaneStep& step = steps_[k];
      Float16 turned(0.0F);
      for (std::size_t e = 0; e < 9; ++e) turned = turned + step.entry(e) * step.entry(e);
      const LaneVector centre = step.travel(ball.centre);
      const double way = root_of_largest(centre.x * centre.x + centre.y * centre.y + centre.z * centre.z);
      const double turn = root_of_largest(turned), farther = way + turn * ball.radius;
      ways_[g] = farther;
      errors_[g] = 16 * u * (turn * ball.reach + farther) + lost * (1.0 + ball.reach);
    }
    waiting_ = 0;
  }

  double root_of_largest(const simd::Float16& squares) const noexcept {
    if (first_ == 0 && end_ == width) return std::sqrt(static_cast<double>(largest(squares)));
    std::array<float, width> each;
    squares.store(each.data());
    return std::sqrt(static_cast<double>(*std::max_element(each.data() + first_, each.data() + end_)));
  }

  std::vector<Ball> balls_;
  std::vector<Pose> reference_;
  std::size_t first_ = 0, end_ = width;
  std::array<double, 8> farthest_{};
  double farthest_of_all_ = 0.0;
  std::array<LaneStep, 4> steps_{};  // of groups not yet processed
  std::array<GroupId, 4> step_of_{};
  std::size_t waiting_ = 0;
  std::vector<double> ways_, errors_;
};

}  // namespace hinge::detail
