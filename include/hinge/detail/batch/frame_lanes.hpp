// SPDX-License-Identifier: BSD-3-Clause
// FrameLanes: frames of rigid groups for sixteen configurations, bit for bit those of single configurations.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/detail/core/sincos.hpp"
#include "hinge/detail/kinematics/compose_frames.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/detail/simd/sincos.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/kinematics/rigid_groups.hpp"

namespace hinge::detail {

/// One configuration per lane, in double. The operations and their order are those of ForwardKinematics, so verdicts on
/// these frames equal those of single queries.
class FrameLanes {
 public:
  static constexpr std::size_t size = simd::width;
  static constexpr std::size_t entries = 12;  ///< of a frame: three columns of the rotation, then the translation

  explicit FrameLanes(const RigidGroups& groups) : joints_(groups.size()), entries_(groups.size() * entries * size) {
    for (std::size_t g = 1; g < groups.size(); ++g) {
      const RigidGroup& group = groups[id<GroupId>(g)];
      LaneJoint& joint = joints_[g];
      joint.parent = static_cast<std::uint32_t>(index(group.parent));
      joint.dof = group.dof;
      joint.slides = group.joint.kind == JointKind::prismatic;
      joint.has_origin = !(group.joint.origin == Pose{});
      joint.origin = Frame(group.joint.origin);
      for (std::size_t k = 0; k < 3; ++k) {
        joint.axis[k] = group.joint.axis[static_cast<Eigen::Index>(k)];
        joint.point[k] = group.joint.point[static_cast<Eigen::Index>(k)];
      }
    }
    for (std::size_t e = 0; e < 9; e += 4) std::fill_n(entries_.data() + e * size, size, 1.0);
  }

  /// Computes all frames. block: 1 to 16 configurations, one after the other; unused lanes repeat the last one. Calls
  /// placed(group) while the group's frames are still in the cache.
  template <class Placed>
  void set(std::span<const double> block, std::size_t dof_count, const Placed& placed) noexcept {
    if (dof_count == 0) return;
    std::array<const double*, size> rows;
    const std::size_t last = block.size() / dof_count - 1;
    for (std::size_t lane = 0; lane < size; ++lane) rows[lane] = block.data() + std::min(lane, last) * dof_count;
    bool small = true;
    for (const double q : block) small &= std::abs(q) <= cody_waite_limit;
    for (std::size_t g = 1; g < joints_.size(); ++g) {
      alignas(64) std::array<double, size> value;
      for (std::size_t lane = 0; lane < size; ++lane) value[lane] = rows[lane][joints_[g].dof];
      for (std::size_t first = 0; first < size; first += half) move(g, first, value.data() + first, small);
      placed(id<GroupId>(g));
    }
  }

  std::size_t group_count() const noexcept { return joints_.size(); }
  /// Sixteen values per entry, one entry after the other.
  const double* operator[](GroupId group) const noexcept { return at(index(group)); }
  Pose pose(GroupId group, std::size_t lane) const noexcept {
    Pose pose;
    const double* from = at(index(group)) + lane;
    for (std::size_t e = 0; e < 9; ++e) pose.rotation.data()[e] = from[e * size];
    for (std::size_t e = 0; e < 3; ++e) pose.translation.data()[e] = from[(9 + e) * size];
    return pose;
  }

 private:
  using Double8 = simd::Double8;
  static constexpr std::size_t half = 8;  // lanes of double per step
  using Motion = std::array<Double8, entries>;

  struct LaneJoint {
    std::uint32_t parent = 0;
    bool slides = false;
    bool has_origin = false;
    std::size_t dof = 0;
    std::array<double, 3> axis{};
    std::array<double, 3> point{};
    Frame origin{};
  };

  const double* at(std::size_t group) const noexcept { return entries_.data() + group * entries * size; }
  double* at(std::size_t group) noexcept { return entries_.data() + group * entries * size; }

  [[gnu::always_inline]] static Motion motion(const LaneJoint& joint, const double* value, bool small) noexcept {
    const Double8 x(joint.axis[0]), y(joint.axis[1]), z(joint.axis[2]), q(value);
    if (joint.slides) {
      const Double8 one(1.0), zero(0.0);
      return {one, zero, zero, zero, one, zero, zero, zero, one, x * q, y * q, z * q};
    }
    Double8 s, c;
    simd::sincos(value, small, s, c);
    const Double8 px(joint.point[0]), py(joint.point[1]), pz(joint.point[2]);
    const auto r = rotation_columns(x, y, z, s, c);
    return {r[0],
            r[1],
            r[2],
            r[3],
            r[4],
            r[5],
            r[6],
            r[7],
            r[8],                                      //
            px - (r[0] * px + r[3] * py + r[6] * pz),  //
            py - (r[1] * px + r[4] * py + r[7] * pz),  //
            pz - (r[2] * px + r[5] * py + r[8] * pz)};
  }

  /// Product of the frame with entries entry(e) and the motion m; see compose().
  template <class Entry>
  [[gnu::always_inline]] static Motion composed(const Entry& entry, const Motion& m) noexcept {
    Motion result;
    for (std::size_t i = 0; i < 3; ++i) {
      const Double8 x = entry(i), y = entry(3 + i), z = entry(6 + i);
      for (std::size_t k = 0; k < 4; ++k) result[3 * k + i] = x * m[3 * k] + y * m[3 * k + 1] + z * m[3 * k + 2];
      result[9 + i] = result[9 + i] + entry(9 + i);
    }
    return result;
  }

  void move(std::size_t g, std::size_t first, const double* value, bool small) noexcept {
    const LaneJoint& joint = joints_[g];
    Motion step = motion(joint, value, small);
    if (joint.has_origin)
      step = composed([&](std::size_t e) { return Double8(joint.origin.column[e / 3 * 4 + e % 3]); }, step);
    const double* parent = at(joint.parent) + first;
    const Motion frame = composed([&](std::size_t e) { return Double8(parent + e * size); }, step);
    double* to = at(g) + first;
    for (std::size_t e = 0; e < entries; ++e) frame[e].store(to + e * size);
  }

  std::vector<LaneJoint> joints_;  // per group; none for the world
  simd::AlignedVector<double> entries_;
};

}  // namespace hinge::detail
