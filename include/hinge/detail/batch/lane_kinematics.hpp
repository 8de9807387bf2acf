// SPDX-License-Identifier: BSD-3-Clause
// LaneKinematics: frames of rigid groups for sixteen configurations, one per float lane.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/batch/lane_error.hpp"
#include "hinge/detail/core/sincos.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/kinematics/rigid_groups.hpp"

namespace hinge::detail {

/// One vector per lane.
struct LaneVector {
  simd::Float16 x, y, z;

  [[gnu::always_inline]] friend LaneVector operator+(const LaneVector& a, const LaneVector& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  [[gnu::always_inline]] friend LaneVector operator-(const LaneVector& a, const LaneVector& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  [[gnu::always_inline]] friend LaneVector operator*(const LaneVector& a, const simd::Float16& f) noexcept {
    return {a.x * f, a.y * f, a.z * f};
  }
};

/// Columns x, y, z of the rotation, then the translation.
using LaneFrame = std::array<LaneVector, 4>;

/// Returns t + x a + y b + z c.
[[gnu::always_inline]] inline LaneVector placed(const LaneFrame& frame, float a, float b, float c) noexcept {
  using simd::Float16;
  return frame[3] + frame[0] * Float16(a) + frame[1] * Float16(b) + frame[2] * Float16(c);
}

/// Sines and cosines of sixteen angles (rad), rounded to float: each within 4 u.
[[gnu::always_inline]] inline void sincos_rounded(const double* angle, simd::Float16& sine,
                                                  simd::Float16& cosine) noexcept {
  using simd::Float16;
  // One product is enough for float: below cody_waite_limit, its rounding and that of pi / 2 add less than 2^-31.
  constexpr double two_over_pi = 0x1.45f306dc9c883p-1, half_pi = 0x1.921fb54442d18p+0;
  std::array<simd::Double8, 2> rest, turns;
  for (std::size_t k = 0; k < 2; ++k) {
    const simd::Double8 x(angle + 8 * k), up(rounder);
    turns[k] = (x * simd::Double8(two_over_pi) + up) - up;
    rest[k] = x - turns[k] * simd::Double8(half_pi);
  }
  const Float16 x = Float16::rounded(rest[0], rest[1]), n = Float16::rounded(turns[0], turns[1]), z = x * x;
  // Taylor polynomials: on |x| <= pi/4 the first omitted terms are below 0.03 u and 0.002 u.
  const Float16 s =
      x + x * z * (Float16(-1.0F / 6) + z * (Float16(1.0F / 120) + z * (Float16(-1.0F / 5040) + z * (1.0F / 362880))));
  const Float16 c = (Float16(1.0F) - z * Float16(0.5F)) +
                    z * z *
                        (Float16(1.0F / 24) +
                         z * (Float16(-1.0F / 720) + z * (Float16(1.0F / 40320) + z * Float16(-1.0F / 3628800))));
  // The quadrant as in simd::sincos: n has 20 bits, so n / 4 - 3 / 8 is exact in float too.
  const Float16 up(0x1.8p23F), one(1.0F);
  const Float16 q = n - Float16(4.0F) * (((n * Float16(0.25F) - Float16(0.375F)) + up) - up);
  const Float16 odd = abs(abs(q - Float16(2.0F)) - one), half(0.5F);
  const Float16 first = choose_less(odd, half, c, s), second = choose_less(odd, half, s, c);
  sine = choose_less(q, Float16(1.5F), first, -first);
  cosine = choose_less(abs(q - Float16(1.5F)), one, -second, second);
}

/// A lane frame differs from the group's frame: its z axis is the joint's axis, its origin lies on this axis, and it is
/// scaled and relative to the lanes' origin. A joint then costs one rotation about z.
class LaneKinematics {
 public:
  /// The lanes' origin is the first moving group's joint at the reference.
  explicit LaneKinematics(const RigidGroups& groups)
      : groups_(groups.size()), joints_(groups.size()), frames_(groups.size()) {
    if (groups.size() > 1) {
      const Joint& first = groups[GroupId{1}].joint;
      groups_[0].in_group.translation = first.origin * first.point;
    }
    for (std::size_t g = 1; g < groups.size(); ++g) {
      const RigidGroup& group = groups[id<GroupId>(g)];
      const Pose& above = groups_[index(group.parent)].in_group;
      Pose& own = groups_[g].in_group;
      own = {turned_to(group.joint.axis), group.joint.point};
      const Pose step = above.inverse() * (group.joint.origin * own);
      joints_[g] = {static_cast<std::uint32_t>(index(group.parent)), group.dof, group.joint.kind, step, {}};
      groups_[g].lengths = {norm(step.translation), norm(group.joint.origin.translation) +
                                                        2 * (norm(group.joint.point) + norm(above.translation))};
    }
  }

  std::size_t size() const noexcept { return frames_.size(); }
  /// The lane frame in the group's frame, not scaled.
  const Pose& in_group(GroupId group) const noexcept { return groups_[index(group)].in_group; }
  /// Transforms `point` from the group's frame to its lane frame.
  Vec3 in_lane_frame(GroupId group, const Vec3& point) const noexcept { return in_group(group).inverse() * point; }

  /// Computes the error bounds of all groups, for values of sliding joints up to `slide` (model length unit).
  void compute_errors(double slide, std::vector<LaneError>& errors) const {
    errors.assign(size(), LaneError(norm(groups_[0].in_group.translation)));
    for (std::size_t g = 1; g < size(); ++g) {
      JointLengths lengths = groups_[g].lengths;
      if (joints_[g].kind == JointKind::prismatic) {
        lengths.offset += slide;
        lengths.detour += slide;
      }
      errors[g] = errors[joints_[g].parent].after(lengths);
    }
  }

  /// Lengths in lanes are model lengths times `scale`, a power of two.
  void set_scale(double scale) {
    scale_ = scale;
    const simd::Float16 zero(0.0F), one(1.0F);
    frames_[0] = {LaneVector{one, zero, zero}, LaneVector{zero, one, zero}, LaneVector{zero, zero, one},
                  LaneVector{zero, zero, zero}};
    for (LaneJoint& joint : joints_) {
      const double largest = joint.step.translation.cwiseAbs().maxCoeff();
      for (std::size_t k = 0; k < 4; ++k) {
        const auto c = static_cast<Eigen::Index>(k);
        const Vec3 column = k < 3 ? Vec3(joint.step.rotation.col(c)) : joint.step.translation;
        joint.columns[k].set(column, k < 3 ? 1.0 : largest, k < 3 ? 1.0 : scale);
      }
    }
  }

  /// Largest magnitude of the values of sliding joints.
  double largest_slide(std::span<const double> block, std::size_t dof_count) const noexcept {
    double largest = 0.0;
    for (std::size_t g = 1; g < size(); ++g)
      if (joints_[g].kind == JointKind::prismatic)
        for (std::size_t k = joints_[g].dof; k < block.size(); k += dof_count)
          largest = std::max(largest, std::abs(block[k]));
    return largest;
  }

  /// Computes all frames. block: 1 to 16 configurations, one after the other, finite. Unused lanes repeat the last one.
  void set(std::span<const double> block, std::size_t dof_count) noexcept {
    if (dof_count == 0) return;
    std::array<const double*, simd::width> rows;
    const std::size_t last = block.size() / dof_count - 1;
    for (std::size_t lane = 0; lane < simd::width; ++lane) rows[lane] = block.data() + std::min(lane, last) * dof_count;
    // Joint by joint: the sines of the next joint overlap with the frame products of this one.
    for (std::size_t g = 1; g < frames_.size(); ++g) {
      const std::size_t dof = joints_[g].dof;
      alignas(64) std::array<double, simd::width> value;
      for (std::size_t lane = 0; lane < simd::width; ++lane) value[lane] = rows[lane][dof];
      move(joints_[g], frames_[joints_[g].parent], value.data(), frames_[g]);
    }
  }

  const LaneFrame& operator[](GroupId group) const noexcept { return frames_[index(group)]; }

 private:
  /// A column of a constant matrix. Most entries of a robot's matrices are zeros and ones.
  struct Column {
    std::array<float, 3> factor{};
    unsigned used = 0;  // bit k: factor k is used

    /// Skips entries below 2^-30 of `largest`: 0.02 u each.
    void set(const Vec3& column, double largest, double scale) noexcept {
      used = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double entry = column[static_cast<Eigen::Index>(k)];
        factor[k] = static_cast<float>(entry * scale);
        if (std::abs(entry) > 0x1p-30 * largest) used |= 1U << k;
      }
    }
  };
  struct LaneJoint {
    std::uint32_t parent = 0;
    std::size_t dof = 0;
    JointKind kind = JointKind::fixed;
    Pose step{};  // lane frame in the parent's lane frame at joint value 0
    std::array<Column, 4> columns{};
  };
  struct Group {
    Pose in_group{};
    JointLengths lengths{};
  };

  static double norm(const Vec3& x) noexcept { return std::sqrt(squared_norm(x)); }

  /// A rotation that maps z to the unit vector `axis`.
  static Mat3 turned_to(const Vec3& axis) noexcept {
    if (axis == Vec3::UnitZ()) return Mat3::Identity();
    Eigen::Index least = 0;
    axis.cwiseAbs().minCoeff(&least);
    Vec3 x = cross(Vec3(Vec3::Unit(least)), axis);
    x /= norm(x);
    Mat3 turn;
    turn.col(0) = x;
    turn.col(1) = cross(axis, x);
    turn.col(2) = axis;
    return turn;
  }

  [[gnu::always_inline]] static LaneVector add_used(const LaneVector& start, const LaneFrame& frame,
                                                    const Column& column, unsigned rest) noexcept {
    LaneVector sum = start;
    for (; rest != 0; rest &= rest - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(rest));
      sum = sum + frame[k] * simd::Float16(column.factor[k]);
    }
    return sum;
  }
  [[gnu::always_inline]] static LaneVector turned(const LaneFrame& frame, const Column& column) noexcept {
    const auto k = static_cast<std::size_t>(std::countr_zero(column.used));
    return add_used(frame[k] * simd::Float16(column.factor[k]), frame, column, column.used & (column.used - 1));
  }

  void move(const LaneJoint& joint, const LaneFrame& parent, const double* value, LaneFrame& frame) const noexcept {
    using simd::Float16;
    const LaneVector x = turned(parent, joint.columns[0]), y = turned(parent, joint.columns[1]);
    frame[2] = turned(parent, joint.columns[2]);
    frame[3] = add_used(parent[3], parent, joint.columns[3], joint.columns[3].used);
    if (joint.kind == JointKind::prismatic) {
      std::array<float, simd::width> slide;
      for (std::size_t k = 0; k < simd::width; ++k) slide[k] = static_cast<float>(value[k] * scale_);
      frame[0] = x;
      frame[1] = y;
      frame[3] = frame[3] + frame[2] * Float16(slide.data());
      return;
    }
    Float16 sine, cosine;
    sincos_rounded(value, sine, cosine);
    const simd::Double8 limit(cody_waite_limit), low(value), high(value + 8);
    if (less(limit, max(abs(low), abs(high))) != 0) [[unlikely]] {
      std::array<float, simd::width> s, c;
      for (std::size_t k = 0; k < simd::width; ++k) {
        const SinCos sc = sincos(value[k]);
        s[k] = static_cast<float>(sc.sin);
        c[k] = static_cast<float>(sc.cos);
      }
      sine = Float16(s.data());
      cosine = Float16(c.data());
    }
    frame[0] = x * cosine + y * sine;
    frame[1] = y * cosine - x * sine;
  }

  std::vector<Group> groups_;
  std::vector<LaneJoint> joints_;  // per group; none for the world
  std::vector<LaneFrame> frames_;
  double scale_ = 1.0;
};

}  // namespace hinge::detail
