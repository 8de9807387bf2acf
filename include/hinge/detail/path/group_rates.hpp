// SPDX-License-Identifier: BSD-3-Clause
// GroupRates: speeds of the rigid groups of a model along a straight path, and bounds of their rounding. Derivation:
// docs/explanation/certified_paths.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/exact/error_free.hpp"
#include "hinge/detail/kinematics/forward_kinematics.hpp"
#include "hinge/detail/path/outline.hpp"
#include "hinge/detail/path/twist.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/path/straight_path.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Data of a group and the joint to its parent. The reference point lies on the joint's axis (prismatic joint: origin
/// of the group's frame; group 0: reference point of group 1). Lengths are scaled (GroupRates::scale). Rates are rad or
/// length per unit of the path's parameter.
struct GroupRate {
  // Constants of the model.
  std::uint32_t parent = 0;
  bool slides = false;
  bool has_primitives = false;
  const Outline* outline = nullptr;
  double radius = 0.0;  ///< largest distance of a primitive's point from the reference point
  double extent = 0.0;  ///< the same from the centre
  // Constants of one path.
  bool stands = true;     ///< its world pose is constant, bit for bit
  double rate = 0.0;      ///< rate of the joint
  double speed = 0.0;     ///< magnitude of rate
  double step = 0.0;      ///< largest distance of this reference point from the parent's
  double summed = 0.0;    ///< sum of angular speeds of all joints from the world to this group
  double chain = 0.0;     ///< largest length of the chain of links from the world's origin to the reference point
  double reach = 0.0;     ///< the same to any point of the group
  double rounding = 0.0;  ///< bound of the rounding of any computed point of it, as a share of the reach
  // At the middle of one segment, in the world.
  Vec3 at = Vec3::Zero();        ///< reference point
  Vec3 centre = Vec3::Zero();    ///< middle of its primitives
  Twist joint;                   ///< motion of the group relative to its parent
  Mat3 axes = Mat3::Identity();  ///< axes of its frame, as columns

  /// Upper bound of the speed of any point of the group under this twist.
  double speed_bound(const Twist& twist) const noexcept { return norm(twist.at(centre)) + norm(twist.turn) * extent; }
  /// A tighter bound that uses directions. It costs a few times more.
  double largest_speed(const Twist& twist) const noexcept {
    const Vec3 velocity = twist.at(centre);
    const double turning = norm(twist.turn) * extent, loose = norm(velocity) + turning;
    // If all points have about the same speed, the tighter bound gains nothing.
    constexpr double worth = 0.25, most = 0x1p900;
    if (outline->is_empty() || !(turning > worth * loose) || !(loose < most)) return loose;
    const auto own = [&](const Vec3& x) { return Vec3(dot(axes.col(0), x), dot(axes.col(1), x), dot(axes.col(2), x)); };
    return outline->largest_speed(own(velocity), own(twist.turn), loose);
  }
};

class GroupRates {
 public:
  template <Primitive P>
  requires HasHull<P>
  explicit GroupRates(const SelectedModel<P>& model);

  /// Starts a path.
  void begin(const StraightPath& path);
  /// Moves to the middle of a segment. frames: world frames of all groups there.
  void set_middle(std::span<const Frame> frames);

  std::span<const GroupRate> groups() const noexcept { return groups_; }
  /// Power of two that scales the model's coordinates to 1 or less, so that squares stay in the range of doubles.
  double scale() const noexcept { return scale_; }
  /// Longest side of the model's bounding box at the reference, model length unit.
  double extent() const noexcept { return extent_; }

 private:
  /// Constants in the group's frame, scaled.
  struct Body {
    Vec3 axis = Vec3::Zero(), point = Vec3::Zero(), centre = Vec3::Zero();
    double step = 0.0;       ///< from the parent's reference point to this one at joint value 0
    double departure = 0.0;  ///< deviation of the joint's origin from a rotation
    std::size_t dof = 0;
  };
  template <Primitive P>
  void find_scale(const SelectedModel<P>& model);
  void add_joint(std::size_t g, const RigidGroup& group);

  std::vector<Body> bodies_;
  std::shared_ptr<const std::vector<Outline>> outlines_;  // per group; groups_ point to them
  std::vector<GroupRate> groups_;
  double scale_ = 1.0;
  double extent_ = 0.0;
};

template <Primitive P>
requires HasHull<P> GroupRates::GroupRates(const SelectedModel<P>& model)
    : bodies_(model.groups()->size()), groups_(bodies_.size()) {
  find_scale(model);
  ForwardKinematics reference(model.groups(), model.selection().size());
  for (std::size_t g = 1; g < bodies_.size(); ++g) add_joint(g, (*model.groups())[id<GroupId>(g)]);
  Aabb all;
  std::vector<Outline> outlines(bodies_.size());
  for (std::size_t g = 0; g < bodies_.size(); ++g) {
    const auto members = model.primitives_of(id<GroupId>(g));
    if (members.empty()) continue;
    Body& body = bodies_[g];
    GroupRate& group = groups_[g];
    group.has_primitives = true;
    Aabb box;
    for (const PrimitiveId i : members) {
      const P& p = model.primitives()[index(i)];
      box.extend(p.bounds());
      all.extend(p.placed(reference.pose(id<GroupId>(g))).bounds());
    }
    for (int k = 0; k < 3; ++k) body.centre[k] = box.middle(k) * scale_;
    std::vector<Vec3> points;
    double largest_size = 0.0;
    for (const PrimitiveId i : members) {
      const P& p = model.primitives()[index(i)];
      const double size = p.hull_radius() * scale_;
      largest_size = std::max(largest_size, size);
      for (const Vec3& x : p.hull()) {
        points.emplace_back(x * scale_);
        group.radius = std::max(group.radius, norm(Vec3(x * scale_ - body.point)) + size);
        group.extent = std::max(group.extent, norm(Vec3(x * scale_ - body.centre)) + size);
      }
    }
    outlines[g] = Outline(points, body.centre, largest_size, group.extent);
  }
  outlines_ = std::make_shared<const std::vector<Outline>>(std::move(outlines));
  for (std::size_t g = 0; g < bodies_.size(); ++g) groups_[g].outline = &(*outlines_)[g];
  if (!all.is_empty()) extent_ = all.length(all.widest_axis());
}

template <Primitive P>
void GroupRates::find_scale(const SelectedModel<P>& model) {
  double largest = 0.0;
  const auto include = [&](const Vec3& x) {
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(x[k]));
  };
  for (std::size_t g = 1; g < bodies_.size(); ++g) {
    include((*model.groups())[id<GroupId>(g)].joint.point);
    include((*model.groups())[id<GroupId>(g)].joint.origin.translation);
  }
  for (const P& p : model.primitives()) {
    include(p.bounds().lower);
    include(p.bounds().upper);
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  scale_ = largest > 0.0 ? std::ldexp(1.0, -std::max(exponent, -1000)) : 1.0;
}

inline void GroupRates::add_joint(std::size_t g, const RigidGroup& group) {
  Body& body = bodies_[g];
  GroupRate& rate = groups_[g];
  rate.parent = static_cast<std::uint32_t>(index(group.parent));
  rate.slides = group.joint.kind == JointKind::prismatic;
  body.dof = group.dof;
  body.axis = group.joint.axis;
  if (!rate.slides) body.point = group.joint.point * scale_;
  const Mat3& r = group.joint.origin.rotation;
  const Vec3 in_parent = product(r, body.point) + group.joint.origin.translation * scale_;
  if (g == 1) groups_[0].at = bodies_[0].point = in_parent;
  body.step = norm(Vec3(in_parent - bodies_[rate.parent].point));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double product_of_columns = dot(Vec3(r.col(i)), Vec3(r.col(j)));
      body.departure = std::max(body.departure, std::abs(product_of_columns - (i == j ? 1.0 : 0.0)));
    }
}

inline void GroupRates::begin(const StraightPath& path) {
  constexpr double u = exact::half_ulp;
  groups_[0].chain = norm(bodies_[0].point);
  groups_[0].reach = groups_[0].chain + groups_[0].radius;
  groups_[0].rounding = rounding_per_joint * u;
  groups_[0].centre = bodies_[0].centre;
  for (std::size_t g = 1; g < groups_.size(); ++g) {  // parents come before their children
    GroupRate& group = groups_[g];
    const GroupRate& parent = groups_[group.parent];
    const Body& body = bodies_[g];
    const double largest = std::max(std::abs(path.from()[body.dof]), std::abs(path.to()[body.dof]));
    group.rate = path.rate()[body.dof] * (group.slides ? scale_ : 1.0);
    group.speed = std::abs(group.rate) * bound_above;
    group.stands = parent.stands && group.rate == 0.0;
    group.step = (body.step + (group.slides ? largest * scale_ : 0.0)) * bound_above;
    group.summed = parent.summed + (group.slides ? 0.0 : group.speed);
    group.chain = parent.chain + group.step;
    group.reach = group.chain + group.radius;
    group.rounding = parent.rounding + rounding_per_joint * u + per_departure * body.departure +
                     rounding_of_values * u * (group.slides ? 1.0 : largest);
  }
}

inline void GroupRates::set_middle(std::span<const Frame> frames) {
  for (std::size_t g = 1; g < groups_.size(); ++g) {
    GroupRate& group = groups_[g];
    const Body& body = bodies_[g];
    const double* column = frames[g].column.data();
    const auto turned = [&](const Vec3& x) -> Vec3 {
      return {column[0] * x[0] + column[4] * x[1] + column[8] * x[2],
              column[1] * x[0] + column[5] * x[1] + column[9] * x[2],
              column[2] * x[0] + column[6] * x[1] + column[10] * x[2]};
    };
    const Vec3 origin = Vec3(column[12], column[13], column[14]) * scale_;
    const double* axis = column;
    for (int k = 0; k < 3; ++k, axis += 4) group.axes.col(k) = Vec3(axis[0], axis[1], axis[2]);
    group.at = turned(body.point) + origin;
    group.centre = turned(body.centre) + origin;
    const Vec3 velocity = turned(body.axis) * group.rate;
    group.joint = group.slides ? Twist{Vec3::Zero(), velocity} : Twist{velocity, cross(group.at, velocity)};
  }
}

}  // namespace hinge::detail
