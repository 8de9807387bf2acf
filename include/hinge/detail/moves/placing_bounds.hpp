// SPDX-License-Identifier: BSD-3-Clause
// PlacingBounds and MoveRounding: bounds of the rounding error of placed coordinates, over all configurations.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/engine/simd/cut_blocks.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Bounds over all configurations with slides up to a limit. Derivation: docs/explanation/moves.md.
class PlacingBounds {
 public:
  template <Primitive P>
  PlacingBounds(const SelectedModel<P>& model, double largest_slide);

  /// Bound of the change of the distance of two primitives in one moving part, by rounding alone, between any two
  /// configurations; model unit.
  double distance_error() const noexcept { return 4.0 * (64.0 * half_ulp * (steps_ + 1.0) + 4.0 * skew_) * size_; }
  /// Bound of the distance between a point moved by the parts' motions and the same point placed by forward kinematics,
  /// after at most `most_kept` changed joints since the frames were composed; model unit.
  double motion_error() const noexcept {
    constexpr double kept = most_kept;
    return ((128.0 * (steps_ + 1.0) + 384.0 * kept * (kept + 1.0)) * half_ulp + (2.0 * kept + 4.0) * skew_) * size_;
  }
  static constexpr std::size_t most_kept = 32;

 private:
  static constexpr double half_ulp = 0x1p-53;

  double size_ = 0.0;   // largest sum of lengths in one product of frames
  double steps_ = 0.0;  // largest number of joints on a path from the world
  double skew_ = 0.0;   // largest sum, along such a path, of the deviations of rotations from orthonormality
};

template <Primitive P>
PlacingBounds::PlacingBounds(const SelectedModel<P>& model, double largest_slide) {
  // Rodrigues' formula with rounded sine, cosine and axis: three entries of 20 half ulps per row.
  constexpr double skew_of_motion = 64.0 * half_ulp;
  // Length factor of rotations that are orthonormal within 1e-3 in sum.
  constexpr double stretch = 1.01;
  const RigidGroups& groups = *model.groups();
  struct Way {
    double length = 0.0, steps = 0.0, skew = 0.0;
    Vec3 anchor = Vec3::Zero();
  };
  std::vector<Way> ways(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    double longest = 0.0;
    for (const PrimitiveId i : model.primitives_of(id<GroupId>(g))) {
      const Aabb box = model.primitives()[index(i)].bounds();
      double squared = 0.0;
      for (int k = 0; k < 3; ++k) squared += std::pow(std::max(std::abs(box.lower[k]), std::abs(box.upper[k])), 2);
      longest = std::max(longest, std::sqrt(squared));
    }
    double own = 2.0 * longest;
    if (g > 0) {
      const RigidGroup& group = groups[id<GroupId>(g)];
      const Joint& joint = group.joint;
      const Way& above = ways[index(group.parent)];
      const double slide = joint.kind == JointKind::prismatic ? largest_slide : 0.0;
      const Vec3 anchor = joint.origin * joint.point;
      const Mat3 square = product(Mat3(joint.origin.rotation.transpose()), joint.origin.rotation);
      ways[g] = {above.length + norm(Vec3(anchor - above.anchor)) + slide, above.steps + 1.0,
                 above.skew + skew_of_motion + (square - Mat3::Identity()).cwiseAbs().rowwise().sum().maxCoeff(),
                 joint.point};
      own += norm(anchor) + 2.0 * norm(joint.point) + norm(joint.origin.translation) + slide;
    }
    size_ = std::max(size_, (ways[g].length + own) * stretch);
    steps_ = std::max(steps_, ways[g].steps);
    skew_ = std::max(skew_, ways[g].skew);
  }
}

/// Error bounds of a move, for slides up to a limit.
class MoveRounding {
 public:
  template <Primitive P>
  explicit MoveRounding(const SelectedModel<P>& model) {
    Aabb around;
    for (const Vec3& middle : middles_at_reference(model)) around.extend(middle);
    if (!around.is_empty()) model_size_ = around.length(around.widest_axis());
  }

  /// Recomputes the bounds for slides up to twice `slide`.
  template <Primitive P>
  void set_slides(const SelectedModel<P>& model, double slide) {
    longest_slide_ = std::max(2.0 * slide, model_size_);
    const PlacingBounds bounds(model, longest_slide_);
    motion_error_ = bounds.motion_error();
    tolerance_ = 2.0 * bounds.distance_error();
    if (!(tolerance_ + motion_error_ <= largest_share * model_size_)) tolerance_ = 0.0;
  }
  double longest_slide() const noexcept { return longest_slide_; }

  /// True if the bounds are small enough to list all pairs that rounding could make collide.
  bool is_small() const noexcept { return tolerance_ > 0.0; }
  /// A pair with d - M at least this large cannot collide while both primitives move together. 0 if bounds are not
  /// small.
  double tolerance() const noexcept { return tolerance_; }
  /// See PlacingBounds.
  double motion_error() const noexcept { return motion_error_; }
  /// Bound of the error when such a distance is compared to a threshold m: m rounds too.
  double pair_error(double m) const noexcept { return 2.0 * motion_error_ + 8.0 * 0x1p-53 * m; }

 private:
  /// Above this share of the model's size, most pairs would be known pairs.
  static constexpr double largest_share = 0x1p-10;

  double model_size_ = 0.0, longest_slide_ = 0.0, tolerance_ = 0.0, motion_error_ = 0.0;
};

}  // namespace hinge::detail
