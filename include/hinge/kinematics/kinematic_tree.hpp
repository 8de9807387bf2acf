// SPDX-License-Identifier: BSD-3-Clause
// KinematicTree: links joined by joints as a spanning tree, plus the closures that turn it into cycles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/kinematics/joint.hpp"

namespace hinge {

/// A cycle of the mechanism: two links that the spanning tree does not join must agree on two points of a line (the
/// hinge or bond that closes the cycle). Points in the frames of the two links, model length unit.
struct Closure {
  LinkId first{};
  LinkId second{};
  std::array<Vec3, 2> in_first{};
  std::array<Vec3, 2> in_second{};
  std::string name{};
};

/// Link 0 is the world; every other link hangs on an earlier one by one joint. Degrees of freedom are numbered in the
/// order their links were added. A configuration is one value per DOF: rad (revolute) or model length unit (prismatic).
class KinematicTree {
 public:
  KinematicTree() : parent_{world}, joint_(1), dof_of_link_(1) {}

  /// Adds a link. ModelError: unknown parent, axis of zero or non-finite length, origin that is no rigid placement.
  LinkId add_link(LinkId parent, Joint joint);

  /// Adds a closure. ModelError: unknown or equal links, non-finite points.
  void add_closure(Closure closure);

  std::size_t link_count() const noexcept { return parent_.size(); }
  std::size_t dof_count() const noexcept { return link_of_dof_.size(); }
  LinkId parent(LinkId link) const noexcept { return parent_[index(link)]; }
  const Joint& joint(LinkId link) const noexcept { return joint_[index(link)]; }
  LinkId link_of(DofId dof) const noexcept { return link_of_dof_[index(dof)]; }
  /// The DOF of a link's own joint; only for links whose joint has one.
  DofId dof_of(LinkId link) const noexcept { return dof_of_link_[index(link)]; }
  std::span<const Closure> closures() const noexcept { return closures_; }

 private:
  std::vector<LinkId> parent_;
  std::vector<Joint> joint_;
  std::vector<DofId> dof_of_link_;
  std::vector<LinkId> link_of_dof_;
  std::vector<Closure> closures_;
};

/// Largest distance (model length unit) between the two positions a closure's points have, given the poses of its
/// links.
inline double closure_residual(const Closure& closure, const Pose& first, const Pose& second) noexcept {
  double worst = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec3 apart = first * closure.in_first[k] - second * closure.in_second[k];
    worst = std::max(worst, std::sqrt(squared_norm(apart)));
  }
  return worst;
}

inline LinkId KinematicTree::add_link(LinkId parent, Joint joint) {
  const std::string who = "link " + std::to_string(link_count()) + (joint.name.empty() ? "" : " (" + joint.name + ")");
  if (index(parent) >= link_count())
    throw ModelError(who + ": parent " + std::to_string(index(parent)) + " does not exist yet");
  if (!is_rigid(joint.origin))
    throw ModelError(who + ": its origin is not a rigid placement (finite, R R^T = 1, det 1)");
  const double length = std::sqrt(squared_norm(joint.axis));
  if (joint.has_dof() && !(is_finite(length) && length > 0.0))
    throw ModelError(who + ": the axis has length " + std::to_string(length) + ", expected a finite length above 0");
  if (!is_finite(joint.point)) throw ModelError(who + ": the axis point is not finite");
  const LinkId link = id<LinkId>(link_count());
  if (joint.has_dof()) joint.axis /= length;
  parent_.push_back(parent);
  dof_of_link_.push_back(id<DofId>(dof_count()));
  if (joint.has_dof()) link_of_dof_.push_back(link);
  joint_.push_back(std::move(joint));
  return link;
}

inline void KinematicTree::add_closure(Closure closure) {
  const std::string who =
      "closure " + std::to_string(closures_.size()) + (closure.name.empty() ? "" : " (" + closure.name + ")");
  if (index(closure.first) >= link_count() || index(closure.second) >= link_count())
    throw ModelError(who + ": joins a link that does not exist");
  if (closure.first == closure.second) throw ModelError(who + ": joins a link with itself");
  for (std::size_t k = 0; k < 2; ++k)
    if (!is_finite(closure.in_first[k]) || !is_finite(closure.in_second[k]))
      throw ModelError(who + ": a point is not finite");
  closures_.push_back(std::move(closure));
}

}  // namespace hinge
